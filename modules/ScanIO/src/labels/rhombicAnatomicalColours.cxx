#include "rhombicAnatomicalColours.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace rhombic
{
namespace
{

using Colour = std::array<std::uint8_t, 3>;

/** A colour for names in which one word begins with \a word and, unless it is empty, another with \a second. A word
 * that ends with '.' has to be a whole word of the name. */
struct Rule
{
  std::string_view word;
  std::string_view second;
  Colour colour;
};

constexpr Colour Bone{ 232, 218, 178 };
constexpr Colour Artery{ 208, 38, 36 };
constexpr Colour Vein{ 52, 92, 176 };
constexpr Colour Muscle{ 172, 66, 58 };
constexpr Colour Cartilage{ 168, 208, 216 };
constexpr Colour Nerve{ 244, 214, 62 };
constexpr Colour Fluid{ 96, 164, 226 };
constexpr Colour Lesion{ 118, 196, 40 };
constexpr Colour Device{ 120, 132, 144 };

// The first that fits counts: what a thing is comes before where it is, the special before the general.
constexpr Rule Rules[] = {
  // findings and devices
  { "lesion", "", Lesion },
  { "tumor", "", Lesion },
  { "tumour", "", Lesion },
  { "metasta", "", Lesion },
  { "carcinoma", "", Lesion },
  { "cancer", "", Lesion },
  { "nodule", "", { 164, 214, 60 } },
  { "cyst.", "", { 72, 196, 172 } },
  { "cysts.", "", { 72, 196, 172 } },
  { "hematoma", "", { 110, 16, 34 } },
  { "haematoma", "", { 110, 16, 34 } },
  { "hemorrhage", "", { 110, 16, 34 } },
  { "haemorrhage", "", { 110, 16, 34 } },
  { "thromb", "", { 128, 24, 72 } },
  { "edema", "", { 128, 206, 236 } },
  { "oedema", "", { 128, 206, 236 } },
  { "effusion", "", { 128, 206, 236 } },
  { "calcifi", "", { 250, 248, 232 } },
  { "stone", "", { 250, 248, 232 } },
  { "implant", "", Device },
  { "catheter", "", Device },
  { "stent", "", Device },
  { "metal", "", Device },
  { "electrode", "", Device },

  // vessels: those of the lungs carry the other blood
  { "pulmonary", "arter", { 76, 108, 206 } },
  { "pulmonary", "vein", { 216, 72, 84 } },
  { "pulmonary", "ven", { 216, 72, 84 } },
  { "portal", "", { 112, 78, 176 } },
  { "cava", "inferior", { 44, 74, 158 } },
  { "cava", "", { 60, 104, 196 } },
  { "vena.", "", Vein },
  { "venae.", "", Vein },
  { "vein", "", Vein },
  { "venous", "", Vein },
  { "sinus", "sagittal", Vein },
  { "sinus", "", { 206, 220, 226 } },
  { "jugular", "", Vein },
  { "aorta", "", { 224, 30, 30 } },
  { "aortic", "", { 224, 30, 30 } },
  { "carotid", "", { 226, 74, 50 } },
  { "brachiocephalic", "", { 232, 92, 62 } },
  { "subclavian", "", { 196, 50, 62 } },
  { "arter", "", Artery },
  { "vessel", "", { 190, 44, 88 } },
  { "vascul", "", { 190, 44, 88 } },
  { "blood", "", { 190, 44, 88 } },

  // nerves and the head's parts
  { "spinal", "canal", { 248, 226, 120 } },
  { "spinal", "cord", Nerve },
  { "nerve", "", Nerve },
  { "optic", "", Nerve },
  { "chiasm", "", Nerve },
  { "csf.", "", Fluid },
  { "ventricle", "lateral", Fluid },
  { "ventricle", "3rd", { 80, 144, 214 } },
  { "ventricle", "4th", { 72, 126, 200 } },
  { "ventricle", "third", { 80, 144, 214 } },
  { "ventricle", "fourth", { 72, 126, 200 } },
  { "white", "cerebell", { 246, 232, 222 } },
  { "cerebell", "", { 204, 148, 132 } },
  { "white", "matter", { 248, 238, 230 } },
  { "brainstem", "", { 228, 190, 148 } },
  { "stem.", "brain", { 228, 190, 148 } },
  { "pons.", "", { 228, 190, 148 } },
  { "hippocamp", "", { 240, 196, 92 } },
  { "amygdala", "", { 150, 190, 226 } },
  { "thalamus", "", { 146, 176, 108 } },
  { "caudate", "", { 132, 168, 206 } },
  { "putamen", "", { 206, 126, 168 } },
  { "pallid", "", { 126, 126, 194 } },
  { "accumbens", "", { 226, 154, 70 } },
  { "corpus", "callosum", { 252, 246, 214 } },
  { "cerebr", "", { 226, 170, 162 } },
  { "cortex", "", { 226, 170, 162 } },
  { "gray", "matter", { 206, 164, 164 } },
  { "grey", "matter", { 206, 164, 164 } },
  { "brain", "", { 232, 176, 168 } },
  { "lens", "", { 192, 230, 242 } },
  { "eye.", "", { 238, 240, 246 } },
  { "eyes.", "", { 238, 240, 246 } },
  { "eyeball", "", { 238, 240, 246 } },
  { "globe", "", { 238, 240, 246 } },

  // cartilage before the bones that it joins
  { "cartilage", "", Cartilage },
  { "disc.", "", Cartilage },
  { "discs.", "", Cartilage },
  { "disk", "", Cartilage },
  { "menisc", "", Cartilage },
  { "ligament", "", { 224, 226, 206 } },
  { "tendon", "", { 224, 226, 206 } },

  // muscles before the bones that they are named after
  { "muscle", "fat", { 238, 202, 110 } },
  { "fat.", "", { 246, 214, 96 } },
  { "adipose", "", { 246, 214, 96 } },
  { "gluteus", "maximus", { 176, 62, 56 } },
  { "gluteus", "medius", { 192, 88, 74 } },
  { "gluteus", "minimus", { 150, 48, 52 } },
  { "iliopsoas", "", { 186, 78, 62 } },
  { "psoas", "", { 186, 78, 62 } },
  { "autochthon", "", { 156, 52, 48 } },
  { "diaphragm", "", { 188, 90, 84 } },
  { "tongue", "", { 214, 104, 106 } },
  { "muscle", "", Muscle },
  { "muscul", "", Muscle },
  { "pectoralis", "", Muscle },
  { "deltoid", "", Muscle },
  { "quadriceps", "", Muscle },

  // bones
  { "sacrum", "", { 202, 176, 130 } },
  { "vertebra", "", Bone },
  { "rib.", "", { 240, 228, 196 } },
  { "ribs.", "", { 240, 228, 196 } },
  { "sternum", "", { 224, 204, 156 } },
  { "clavic", "", { 244, 224, 160 } },
  { "scapula", "", { 214, 196, 148 } },
  { "humerus", "", { 236, 224, 188 } },
  { "femur", "", { 238, 222, 180 } },
  { "hip.", "", { 222, 202, 160 } },
  { "hips.", "", { 222, 202, 160 } },
  { "pelvis", "", { 222, 202, 160 } },
  { "skull", "", { 238, 226, 192 } },
  { "crani", "", { 238, 226, 192 } },
  { "mandib", "", { 220, 204, 160 } },
  { "jaw", "", { 220, 204, 160 } },
  { "maxilla", "", { 228, 214, 174 } },
  { "teeth", "", { 250, 246, 226 } },
  { "tooth", "", { 250, 246, 226 } },
  { "patella", "", Bone },
  { "tibia", "", { 230, 214, 170 } },
  { "fibula", "", { 216, 200, 158 } },
  { "radius", "", { 230, 214, 170 } },
  { "ulna", "", { 216, 200, 158 } },
  { "carpal", "", Bone },
  { "tarsal", "", Bone },
  { "metacarpal", "", Bone },
  { "metatarsal", "", Bone },
  { "phalan", "", Bone },
  { "spine", "", Bone },
  { "skelet", "", Bone },
  { "bone", "", Bone },

  // glands and lymph
  { "adrenal", "", { 236, 170, 48 } },
  { "thyroid", "", { 168, 46, 92 } },
  { "parotid", "", { 220, 168, 120 } },
  { "salivary", "", { 220, 168, 120 } },
  { "submandibular", "", { 208, 150, 104 } },
  { "pituitary", "", { 214, 128, 96 } },
  { "thymus", "", { 224, 152, 148 } },
  { "lymph", "", { 124, 176, 116 } },
  { "prostate", "", { 214, 142, 88 } },
  { "seminal", "", { 226, 180, 126 } },
  { "gland", "", { 220, 168, 120 } },

  // heart
  { "atri", "appendage", { 214, 112, 128 } },
  { "atri", "", { 204, 84, 96 } },
  { "ventric", "", { 158, 40, 52 } },
  { "myocard", "", { 142, 30, 38 } },
  { "pericard", "", { 234, 188, 128 } },
  { "heart", "", { 178, 46, 54 } },
  { "cardi", "", { 178, 46, 54 } },

  // airways and lungs
  { "trachea", "", { 156, 214, 226 } },
  { "bronch", "", { 140, 196, 220 } },
  { "airway", "", { 140, 196, 220 } },
  { "larynx", "", { 148, 190, 196 } },
  { "pharynx", "", { 206, 134, 126 } },
  { "lung", "upper", { 240, 178, 176 } },
  { "lung", "middle", { 222, 144, 158 } },
  { "lung", "lower", { 206, 152, 140 } },
  { "lung", "", { 234, 168, 166 } },
  { "air.", "", { 196, 228, 246 } },
  { "gas.", "", { 196, 228, 246 } },

  // abdomen and pelvis
  { "gallbladder", "", { 74, 142, 58 } },
  { "gall.", "", { 74, 142, 58 } },
  { "bile", "", { 74, 142, 58 } },
  { "biliary", "", { 74, 142, 58 } },
  { "liver", "", { 134, 54, 36 } },
  { "hepat", "", { 134, 54, 36 } },
  { "spleen", "", { 116, 38, 78 } },
  { "pancrea", "", { 238, 190, 112 } },
  { "ureter", "", { 226, 206, 116 } },
  { "urethra", "", { 226, 206, 116 } },
  { "kidney", "", { 164, 82, 50 } },
  { "renal", "", { 164, 82, 50 } },
  { "bladder", "", { 238, 216, 128 } },
  { "duodenum", "", { 226, 146, 70 } },
  { "colon", "", { 190, 150, 90 } },
  { "rectum", "", { 168, 104, 84 } },
  { "bowel", "large", { 190, 150, 90 } },
  { "bowel", "", { 230, 158, 136 } },
  { "intestin", "large", { 190, 150, 90 } },
  { "intestin", "", { 230, 158, 136 } },
  { "stomach", "", { 212, 116, 124 } },
  { "esophagus", "", { 198, 132, 150 } },
  { "oesophagus", "", { 198, 132, 150 } },
  { "uter", "", { 216, 116, 140 } },
  { "ovar", "", { 240, 196, 190 } },
  { "testi", "", { 226, 186, 164 } },
  { "breast", "", { 240, 190, 166 } },

  // the whole
  { "skin", "", { 226, 174, 140 } },
  { "face.", "", { 226, 174, 140 } },
  { "body", "", { 226, 174, 140 } },
  { "trunc", "", { 226, 174, 140 } },
  { "extremit", "", { 218, 164, 130 } },
  { "tissue", "", { 212, 158, 130 } },
};

bool
IsLetter(char letter)
{
  return letter >= 'a' && letter <= 'z';
}

bool
IsDigit(char letter)
{
  return letter >= '0' && letter <= '9';
}

/** The words of a name in lower case. Words end where letters, digits or capitals begin: leftKidney, T12. */
std::vector<std::string>
WordsOfName(const std::string & name)
{
  std::vector<std::string> words(1);
  char previous = ' ';
  for (const char letter : name)
  {
    const bool isCapital = letter >= 'A' && letter <= 'Z';
    const char lower = isCapital ? static_cast<char>(letter - 'A' + 'a') : letter;
    const bool isHump = isCapital && IsLetter(previous);
    const bool isNumber = IsDigit(letter) && !IsDigit(previous);
    if (isHump || isNumber || !(IsLetter(lower) || IsDigit(lower)))
    {
      words.emplace_back();
    }
    if (IsLetter(lower) || IsDigit(lower))
    {
      words.back() += lower;
    }
    previous = letter;
  }
  return words;
}

bool
HasWord(const std::vector<std::string> & words, std::string_view wanted)
{
  const bool isWhole = wanted.back() == '.';
  wanted.remove_suffix(isWhole ? 1 : 0);
  return std::any_of(words.begin(), words.end(), [&](const std::string & word) {
    return word.compare(0, wanted.size(), wanted) == 0 && (!isWhole || word.size() == wanted.size());
  });
}

bool
HasOddNumber(const std::vector<std::string> & words)
{
  const auto number = std::find_if(
    words.rbegin(), words.rend(), [](const std::string & word) { return !word.empty() && IsDigit(word.back()); });
  return number != words.rend() && (number->back() - '0') % 2 == 1;
}

/** Nearer to white by a fraction, or to black by a negative one. */
Colour
Lighten(Colour colour, double fraction)
{
  for (std::uint8_t & component : colour)
  {
    const double target = fraction > 0 ? 255 : 0;
    component = static_cast<std::uint8_t>(std::lround(component + std::abs(fraction) * (target - component)));
  }
  return colour;
}

/** A colour of the hue circle, all of them about equally vivid. */
Colour
ColourOfHue(double turns, double saturation, double brightness)
{
  const auto component = [&](double offset) {
    const double position = std::fmod(turns + offset, 1.0) * 6;
    const double share = std::clamp(std::abs(position - 3) - 1, 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255 * brightness * (1 - saturation * (1 - share))));
  };
  return { component(0), component(2.0 / 3), component(1.0 / 3) };
}

/** Hues a golden angle apart. Values that get nearly the same hue (5, 8 and 13 apart) differ in saturation or
 * brightness. */
Colour
ColourOfValue(std::int32_t value)
{
  constexpr double goldenAngle = 0.381966011250105; // turns
  constexpr double saturations[3] = { 0.62, 0.4, 0.82 };
  constexpr double brightnesses[5] = { 0.92, 0.7, 0.84, 0.6, 0.77 };
  const std::int64_t number = std::int64_t{ value } - std::numeric_limits<std::int32_t>::min();
  const double turns = std::fmod(static_cast<double>(number) * goldenAngle, 1.0);
  return ColourOfHue(turns, saturations[number % 3], brightnesses[number % 5]);
}

} // namespace

std::array<std::uint8_t, 3>
AnatomicalColour(const std::string & name, std::int32_t value)
{
  const std::vector<std::string> words = WordsOfName(name);
  const auto * const rule = std::find_if(std::begin(Rules), std::end(Rules), [&words](const Rule & candidate) {
    return HasWord(words, candidate.word) && (candidate.second.empty() || HasWord(words, candidate.second));
  });
  if (rule == std::end(Rules))
  {
    return ColourOfValue(value);
  }
  const bool beginsWithL = words.size() > 1 && words[0] == "l" && !IsDigit(words[1][0]); // L1 is a vertebra
  const bool isLeft = HasWord(words, "left.") || HasWord(words, "sinist") || words.back() == "l" || beginsWithL;
  const Colour sided = Lighten(rule->colour, isLeft ? 0.2 : 0.0);
  return Lighten(sided, HasOddNumber(words) ? -0.1 : 0.0);
}

} // namespace rhombic
