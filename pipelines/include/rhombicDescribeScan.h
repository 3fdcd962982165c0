#ifndef rhombicDescribeScan_h
#define rhombicDescribeScan_h

#include "rhombicScanSource.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rhombic
{

/** A suggested isovalue, and the tissue that it shows. */
struct SuggestedThreshold
{
  std::string surface; ///< the tissue, such as "bone"
  double isovalue;
};

/** The content of a file or folder. */
struct ScanDescription
{
  /** The volume that was read; none where a folder has several series of which none was chosen or could be read. */
  std::variant<std::monostate, Scan, FCCVolume> volume;

  Intensities intensities;                         ///< intensities of the volume
  std::vector<SuggestedThreshold> thresholds;      ///< none for label maps
  std::optional<std::vector<LabelSummary>> labels; ///< labels of the volume, or of the label map named for it
  std::vector<SeriesSummary> series;               ///< all series in the folder, with their spacings; DICOM only
  std::string choice;                              ///< why the series that was read was chosen
  std::size_t filesConsidered = 0;                 ///< as Scan::filesConsidered
  std::map<std::string, std::size_t> filesSkipped; ///< as Scan::filesSkipped
  std::vector<std::string> notes;                  ///< notes on the scan, the label map and single files

  bool
  HasVolume() const
  {
    return !std::holds_alternative<std::monostate>(volume);
  }

  /** Whether there are series, and each has a problem. */
  bool
  IsUnreadable() const;
};

/** Reads a scan, and lists the series beside it. Of several series, none of which is named, it describes the series
 * that itk::NativeScanFileReader would choose, or their list alone. Files of several volumes are described by their
 * first.
 *
 * \param labels the scan's label map, or an empty path for none; its table is used if the scan itself is a label map
 *
 * Throws Failure. */
ScanDescription
DescribeScan(const ScanSource & source, const LabelMapSource & labels);

/** The preset that "auto" stands for. */
struct PresetChoice
{
  std::string preset; ///< its name; empty for none
  std::string reason; ///< "the scan is ..."

  /** "ct-bone, as the scan is a CT in HU without air". */
  std::string
  Describe() const
  {
    return (preset.empty() ? "none" : preset) + ", as " + reason;
  }
};

/** The preset for a volume; none for label maps, and for labels of scans that are no CT in HU, which need none.
 *
 * | scan | preset |
 * |---|---|
 * | CT in HU with air, and with labels | ct-organs |
 * | CT in HU; of unknown modality with values below -900 and of bone | ct-bone-skin |
 * | CT in HU without values of bone; without air | ct-skin; ct-bone |
 * | CT whose values are all -200 or above, which are not taken for HU | uncalibrated-ct |
 * | PET | pet-hot-spots |
 * | MR of the head, by its body part; other MR | mr-head; mr-outline |
 * | anything else, and lattice volumes | outline |
 *
 * \param hasLabels whether labels are shown, too
 *
 * Throws Failure. */
PresetChoice
ChoosePreset(const SourceVolume & volume, bool hasLabels);

} // namespace rhombic

#endif
