#include "rhombicDicomHeader.h"

#include "rhombicWording.h"

#include <algorithm>
#include <string_view>

namespace rhombic
{
namespace
{

using Words = std::set<std::string_view>;

Words
WordsOf(std::string_view text)
{
  const auto words = SplitWords(text);
  return { words.begin(), words.end() };
}

// PS3.3, C.7.3.1.1.1: modalities of images, and of other objects in the same folders.
const Words Modalities =
  WordsOf("AR AU BDUS BI BMD CR CT CTPROTOCOL DG DOC DX ECG EPS ES FID GM HD IO IOL IVOCT IVUS KER KO LEN LS M3D MG MR "
          "NM OAM OCT OP OPM OPT OPTBSV OPTENF OPV OSS OT PA PLAN PR PT PX REG RESP RF RG RTDOSE RTIMAGE RTPLAN "
          "RTRECORD RTSTRUCT RWV SC SEG SM SMR SR SRF STAIN TG US VA XA XAPROTOCOL XC");

// Words of the standard, and of vendors whose image types separate slices at the same position.
const Words ImageTypeWords =
  WordsOf("2D 3D ACQUIRED ADC ADD ADDITION AVERAGE AXIAL B0 B1 BODY COMPLEX CORONAL CSA CT DERIVED DIFFUSION DIS2D "
          "DIS3D DIXON DUAL DYNAMIC ECHO EMISSION ENERGY EPI F FA FAT FFE FIELD FILTERED FM FS FSE GATED GE GRE HU I "
          "IMAGE IMAGINARY IN INV IP IR LOCALIZER M MAG MAGNITUDE MAP MATERIAL MAX MEAN MFSPLIT MIN MINIP MIP MIXED "
          "MONOENERGETIC MPR ND NONE NORM OP OPP ORIGINAL OTHER OUT P PERFUSION PHASE PRIMARY PROJECTION PROTON R REAL "
          "RECON REFORMATTED RESAMPLED ROOT SAGITTAL SE SECONDARY SEQUENCE SOM5 SOM7 SPI SPIN SPR SQUARE STATIC STDDEV "
          "SUB SUBTRACTION SW SWI T1 T2 T2STAR TFE TOF TOMO TRACEW TSE VELOCITY VMI VOLUME W WATER WHOLE");

// PS3.16, table L-1, without parts of single organs.
const Words BodyParts =
  WordsOf("ABDOMEN ABDOMENPELVIS ANKLE ARM BRAIN BREAST CHEST CHESTABDOMEN CHESTABDPELVIS CSPINE ELBOW EXTREMITY FEMUR "
          "FOOT FOREARM HAND HEAD HEADNECK HEART HIP HUMERUS KNEE LEG LIVER LSPINE LUNG NECK NECKCHEST PELVIS PROSTATE "
          "SHOULDER SKULL SPINE THIGH TSPINE WHOLEBODY WRIST");

// PS3.3, C.8.9.1.1.3.
const std::map<std::string_view, std::string> UnitNames{ { "BQML", "Bq/ml" },       { "GML", "g/ml" },
                                                         { "CNTS", "counts" },      { "CPS", "counts/s" },
                                                         { "CM2ML", "cm2/ml" },     { "PCNT", "%" },
                                                         { "UMOLMIN", "umol/min" }, { "MLMING", "ml/min/g" } };

bool
HasOnly(const std::string & text, std::string_view letters)
{
  return text.find_first_not_of(letters) == std::string::npos;
}

std::string
Disguised(const std::string & text)
{
  return "other-" + HashText(text).substr(12);
}

} // namespace

std::string
ModalityOf(const std::string & text)
{
  return text.empty() || Modalities.count(text) != 0 ? text : "other";
}

std::string
BodyPartOf(const std::string & text)
{
  return BodyParts.count(text) != 0 ? text : "";
}

std::string
UnitsOf(const std::string & text)
{
  const auto found = UnitNames.find(text);
  return found != UnitNames.end() ? found->second : "";
}

std::string
ImageTypeOf(const std::string & text)
{
  std::string type;
  for (const std::string & value : Split(text, "\\"))
  {
    const auto words = Split(value, " _");
    const bool isKnown = std::all_of(words.begin(), words.end(), [](const std::string & word) {
      return word.empty() || ImageTypeWords.count(word) != 0;
    });
    type += (type.empty() ? "" : "\\") + (isKnown ? value : Disguised(value));
  }
  return type;
}

std::string
NumberTextOf(const std::string & text)
{
  constexpr std::size_t longest = 64;
  return text.size() <= longest && HasOnly(text, "0123456789+-.eE\\ ") ? text : "";
}

std::string
NameCodeOf(const std::string & text)
{
  constexpr std::size_t longest = 4;
  return text.size() <= longest && HasOnly(text, "0123456789") ? text : Disguised(text);
}

} // namespace rhombic
