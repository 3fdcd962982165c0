#include "rhombicCommands.h"
#include "rhombicCompareLabels.h"
#include "rhombicFailure.h"
#include "rhombicRenderAgreement.h"
#include "rhombicScanOptions.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iostream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace rhombic
{
namespace
{

/** Has large blocks given back as soon as they are freed, as the C library does by itself, but main() does not: the
 * walls of two maps are made one after the other, and what is left of the first made the second need a quarter more. */
void
GiveBackLargeBlocks()
{
#ifdef __GLIBC__
  constexpr int smallest = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, smallest);
  mallopt(M_TRIM_THRESHOLD, 2 * smallest);
#endif
}

struct CompareLabelsOptions
{
  std::string first;
  std::string second;
  bool areSurfaces = false;
  std::string threshold;
  std::string firstTable;
  std::string secondTable;
  std::vector<std::string> pairs;
  bool isByValue = false;
  std::vector<std::string> only;
  std::vector<std::string> hidden;
  std::string tolerance = "1";
  std::string surface = "smooth";
  std::string transform;
  bool isTransformInverted = false;
  std::vector<std::string> dates;
  std::vector<std::string> parts;
  std::string voxelMetrics;
  std::string output;
  std::string page;
  std::optional<double> range;
  ScanOptions scan;
};

/** Pairs written as liver=Leber or 5=12. */
std::pair<std::string, std::string>
ParsePair(const std::string & text)
{
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
  {
    throw Failure(FailureKind::Usage,
                  "'" + text + "' is no pair of labels; write --pair liver=Leber, the label of A first.");
  }
  return { text.substr(0, equals), text.substr(equals + 1) };
}

bool
HasDigit(const std::string & text)
{
  return std::any_of(text.begin(), text.end(), [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

/** One length for all labels, or a file of lines with the name of a label, which may hold * and ?, and its length. */
std::vector<LabelTolerance>
ParseTolerances(const std::string & text)
{
  if (const auto length = ToNumber<double>(text))
  {
    return { { "*", *length } };
  }
  std::ifstream file(text);
  if (!file)
  {
    throw Failure(FailureKind::Usage,
                  "'" + text +
                    "' is neither a length in mm nor a readable table of lengths; write --tolerance 1.5, or "
                    "name a file of lines as liver,2.");
  }
  std::vector<LabelTolerance> tolerances;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number)
  {
    const std::vector<std::string> fields = Split(line, ",;\t");
    const auto length = fields.size() == 2 ? ToNumber<double>(Trim(fields[1])) : std::nullopt;
    if (length)
    {
      tolerances.push_back({ std::string(Trim(fields[0])), *length });
    }
    else if (!Trim(line).empty() && (number > 1 || HasDigit(fields.back()))) // the first line may be a heading
    {
      throw Failure(FailureKind::Usage,
                    "Line " + std::to_string(number) + " of " + text +
                      " is no name of a label and a length in mm; "
                      "write it as liver,2.");
    }
  }
  return tolerances;
}

ComparedKind
ParseKind(const CompareLabelsOptions & options, SurfaceRequest & isosurface)
{
  if (options.threshold.empty())
  {
    return options.areSurfaces ? ComparedKind::Surfaces : ComparedKind::Labels;
  }
  isosurface.name = "surface";
  if (!ParseThreshold(options.threshold, isosurface))
  {
    throw Failure(FailureKind::Usage,
                  "The threshold '" + options.threshold + "' is no number; write -t -300.5, or -t otsu.");
  }
  return ComparedKind::Isosurfaces;
}

CompareLabelsSettings
GetSettings(const CompareLabelsOptions & options, const CommandSettings & command)
{
  if (options.first.empty() || options.second.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Two segmentations are needed; name both, as rhombic compare-labels A.nii.gz "
                  "B.nii.gz.");
  }
  CompareLabelsSettings settings;
  ScanOptions scan = options.scan;
  scan.scan = options.first;
  settings.first = scan.GetSource();
  scan.scan = options.second;
  settings.second = scan.GetSource();
  settings.kind = ParseKind(options, settings.isosurface);
  settings.firstTable = options.firstTable;
  settings.secondTable = options.secondTable.empty() ? options.firstTable : options.secondTable;
  for (const std::string & pair : options.pairs)
  {
    settings.pairs.push_back(ParsePair(pair));
  }
  settings.pairsByValue = options.isByValue;
  settings.only = options.only;
  settings.hidden = options.hidden;
  settings.tolerances = ParseTolerances(options.tolerance);
  settings.toleranceTable = ToNumber<double>(options.tolerance) ? "" : options.tolerance;
  settings.takesVoxelSurfaces =
    FindNamed<bool>("kind of surface", options.surface, { { "smooth", false }, { "voxels", true } });
  settings.transform = options.transform;
  settings.isTransformInverted = options.isTransformInverted;
  if (!options.dates.empty())
  {
    if (options.dates.size() != 2)
    {
      throw Failure(FailureKind::Usage, "--dates takes two dates, as --dates 2025-01-03,2026-01-10.");
    }
    settings.days = CountDays(options.dates[0], options.dates[1]);
  }
  settings.parts = options.parts;
  settings.hasVoxelMetrics = !options.voxelMetrics.empty() &&
                             FindNamed<bool>("kind of voxel metrics", options.voxelMetrics, { { "deepmind", true } });
  settings.table = options.output;
  settings.page = options.page;
  settings.provenance = options.scan.GetProvenance(command);
  return settings;
}

const SettingsTable<CompareLabelsOptions> &
InputTable()
{
  using Options = CompareLabelsOptions;
  static const SettingsTable<Options> table{
    { "A",
      &Options::first,
      "a segmentation: label map, DICOM SEG, mask or folder of masks; with --surfaces a surface file, with -t a scan",
      OfKind(SettingKind::Source) },
    { "B", &Options::second, "the segmentation that is compared with A", OfKind(SettingKind::Source) },
    { "--surfaces", &Options::areSurfaces, "A and B are files of closed surfaces", Excludes({ "--threshold" }) },
    { "-t,--threshold",
      &Options::threshold,
      "A and B are scans, of which the isosurfaces at this threshold are compared: a number, <number for what lies "
      "below, otsu" },
    { "--label-table",
      &Options::firstTable,
      "names of A's labels, and of B's if --label-table-b is not given (default: in or beside the maps)",
      OfKind(SettingKind::InputFile) },
    { "--label-table-b", &Options::secondTable, "names of B's labels", OfKind(SettingKind::InputFile) },
    { "--pair",
      &Options::pairs,
      "a label of A and the label of B that it is compared with, by name or value: liver=Leber, 5=12; repeatable",
      SplitAtCommas },
    { "--by-value", &Options::isByValue, "pair labels by value, even if they have names", Excludes({ "--surfaces" }) },
    { "--only",
      &Options::only,
      "the labels to compare, by name with * and ?, or by group, as in render; repeatable",
      SplitAtCommas },
    { "--hide", &Options::hidden, "labels that are left out, as --only names them; repeatable", SplitAtCommas },
  };
  return table;
}

const SettingsTable<CompareLabelsOptions> &
MeasureTable()
{
  using Options = CompareLabelsOptions;
  static const SettingsTable<Options> table{
    { "--tolerance",
      &Options::tolerance,
      "tolerance of the normalised surface Dice in mm, or a file of lines with a label and its tolerance: liver,2",
      OfKind(SettingKind::InputFile),
      ShowingDefault },
    { "--surface",
      &Options::surface,
      "surfaces of label maps: smooth, which hold the voxels' volume, or voxels, the faces of the voxels",
      ShowingDefault },
    { "--transform",
      &Options::transform,
      "a rigid or affine transform of ITK in text (.tfm) that maps points of A's space to B's, as a registration "
      "writes it with A fixed",
      OfKind(SettingKind::Source) },
    { "--transform-inverse",
      &Options::isTransformInverted,
      "the transform maps points of B's space to A's, as a registration writes it with B fixed",
      Needs({ "--transform" }) },
    { "--dates",
      &Options::dates,
      "dates of A and of B, as 2025-01-03,2026-01-10: the table has the growth of each label in ml a year, and the "
      "days in which it doubles",
      OfKind(SettingKind::Source),
      SplitAtCommas },
    { "--parts",
      &Options::parts,
      "labels whose parts are compared one by one, as lesions in a follow-up, by name with * and ?: parts of A and B "
      "that overlap are one row; the table tells which are kept, new, gone, split and merged; repeatable",
      Excludes({ "--surfaces", "--threshold" }),
      SplitAtCommas },
    { "--voxel-metrics",
      &Options::voxelMetrics,
      "further columns with the distances between voxels that published tables have: deepmind, those of its program "
      "surface-distance; the maps have one grid",
      Excludes({ "--surfaces", "--threshold" }) },
    { "-o,--output",
      &Options::output,
      "table of the agreement: .csv, .tsv or .json (default: printed)",
      OfKind(SettingKind::Output) },
    { "--sheet",
      &Options::page,
      "also draw a page, A4: A's surfaces coloured by distance from B's, slices with both outlines, and the table, "
      "worst labels first: .pdf, .png, .jpg, .tif, or .html for an interactive page",
      OfKind(SettingKind::Output) },
    { "--range",
      &Options::range,
      "largest distance in mm that has a colour of its own on the page (default: what 95 % of the points have)",
      Needs({ "--sheet" }) },
    { "--max-memory",
      &Options::scan,
      &ScanOptions::maximumMemory,
      "most memory for a volume, as 8G or 500M (default: half of what is free)",
      DefaultsTo("RHOMBIC_MAX_MEMORY"),
      InBytes,
      OfKind(SettingKind::Run) },
    { "--no-sidecar",
      &Options::scan,
      &ScanOptions::hasNoSidecar,
      "do not write the report beside the table (OUTPUT.json)",
      OfKind(SettingKind::Run) },
  };
  return table;
}

} // namespace

CommandRun
AddCompareLabelsCommand(CommandSettings & command)
{
  const auto options = std::make_shared<CompareLabelsOptions>();
  command.Add(InputTable(), *options);
  command.Add(MeasureTable(), *options);
  return [options](const CommandContext & context) {
    const CompareLabelsSettings settings = GetSettings(*options, *context.settings);
    std::vector<MadeFile> outputs;
    AddOutputs(CheckCompareLabels(settings), "", outputs);
    CheckAgreementPage(settings, options->range);
    if (context.onlyChecks)
    {
      return outputs;
    }
    GiveBackLargeBlocks();
    const Events events = context.console->MakeEvents();
    const std::vector<LabelAgreement> agreement = CompareLabels(settings, events, outputs);
    if (!settings.page.empty())
    {
      const std::vector<MadeFile> pages = RenderAgreement(settings, agreement, options->range, events);
      outputs.insert(outputs.end(), pages.begin(), pages.end());
    }
    if (settings.table.empty())
    {
      context.console->Finish();
      std::cout << DescribeAgreement(agreement);
    }
    NoteOutputs("table", outputs, *context.console);
    return outputs;
  };
}

} // namespace rhombic
