#include "rhombicSurfaceOptions.h"

#include "rhombicDescribeScan.h"
#include "rhombicFailure.h"

namespace rhombic
{
const SettingsTable<SurfaceOptions> &
SurfaceOptions::Table()
{
  static const SettingsTable<SurfaceOptions> table{
    { "--preset",
      &SurfaceOptions::preset,
      "surfaces by a preset's name, or by a .yaml file like those of the project; auto chooses one by what the scan "
      "says and by its values",
      OfKind(SettingKind::InputFile) },
    { "--surface",
      &SurfaceOptions::surfaces,
      "name=threshold[,colour[,opacity]]; colour: #rrggbb, #rgb or a name, as white; threshold: a number, <number for "
      "what lies below, otsu, otsu-low, otsu-lowest or otsu-high; repeatable" },
    { "--labels",
      &SurfaceOptions::labels,
      "the surfaces of the scan's label map: NIfTI, NRRD, MetaImage or DICOM SEG, or a folder of masks (not needed "
      "when SCAN itself is one); repeatable, for several that are one segmentation",
      OfKind(SettingKind::Source) },
    { "--probabilities",
      &SurfaceOptions::probabilities,
      "in place of --labels: a volume of probabilities of each label, or one file of several volumes; labels meet "
      "where they are equally probable; repeatable",
      Excludes({ "--labels" }),
      OfKind(SettingKind::Source) },
    { "--label-table",
      &SurfaceOptions::labelTable,
      "names and colours of labels (ITK-SNAP, Slicer, FreeSurfer, BIDS, nnU-Net, CSV; default: in or beside the map)",
      OfKind(SettingKind::InputFile) },
    { "--unnamed-mask", // batches set it, as the names of their files may be the patients'
      &SurfaceOptions::leavesMaskUnnamed,
      "do not call the label of a mask as its file",
      Hidden },
    { "--label",
      &SurfaceOptions::chosenLabels,
      "one of the labels, by name (with * and ?) or value, and how to draw it: liver, 'rib*', liver=#994736,0.5; "
      "repeatable (default: all)" },
    { "--only",
      &SurfaceOptions::only,
      "the surfaces and labels to show, by name with * and ?, or by group (group:bones, group:vessels, group:lungs, "
      "group:heart, group:brain, group:muscles, group:organs): 'liver,kidney*'; repeatable",
      SplitAtCommas },
    { "--hide",
      &SurfaceOptions::hidden,
      "surfaces and labels that are left out, as --only names them; repeatable",
      SplitAtCommas },
    { "--draw",
      &SurfaceOptions::looks,
      "colour, opacity and look (matte or glossy) of surfaces and labels by name or group: 'skin=,0.3', "
      "'group:bones=ivory', 'vessels=,,glossy'; repeatable, later ones count more" },
    { "--colours",
      &SurfaceOptions::labelColours,
      "colours of labels: anatomy (for names that are known), file (those of the label table) or safe (for "
      "colour-blind people)",
      ShowingDefault },
    { "--remove-table",
      &SurfaceOptions::removesTable,
      "set table, head holder and sheets around the patient of a CT to air, as the ct- presets do" },
    { "--keep-table",
      &SurfaceOptions::keepsTable,
      "keep them although the preset removes them",
      Excludes({ "--remove-table" }) },
    { "--mode",
      &SurfaceOptions::mode,
      "triangles: lean (a third to half as many as tetrahedra; on smooth surfaces well-shaped and as close as marching "
      "cubes), fine (closest to the truth), tetrahedra, octahedra or parallelepipeds",
      ShowingDefault },
  };
  return table;
}

Preset
SurfaceOptions::GetNamedPreset() const
{
  return preset.empty() || preset == "auto" ? Preset() : FindPreset(preset);
}

Preset
SurfaceOptions::GetPreset(ScanSource & source, std::optional<SourceVolume> & volume, const Events & events) const
{
  std::string name = preset;
  const bool choosesNothing = takesAuto && !ChoosesSurfaces() && labelTable.empty();
  if (preset == "auto" || choosesNothing)
  {
    volume = LoadVolume(source, events);
    const PresetChoice choice = ChoosePreset(*volume, !labels.empty() || !probabilities.empty());
    name = choice.preset;
    if (!choosesNothing || !name.empty()) // a label map needs no choice
    {
      source.presetChoice = choice.Describe();
      events.Note((choosesNothing ? "no surface is chosen; --preset auto takes " : "preset: ") + source.presetChoice);
    }
  }
  return name.empty() ? Preset() : FindPreset(name);
}

SurfaceSelection
SurfaceOptions::GetSelection(const Preset & chosen, const std::optional<SurfaceRequest> & further) const
{
  SurfaceSelection selection;
  using Mode = itk::FCCIsosurfaceMode;
  selection.mode = FindNamed<Mode>("mode",
                                   mode,
                                   { { "lean", Mode::Lean },
                                     { "fine", Mode::Fine },
                                     { "tetrahedra", Mode::Tetrahedra },
                                     { "octahedra", Mode::Octahedra },
                                     { "parallelepipeds", Mode::Parallelepipeds } });
  selection.requests = chosen.surfaces;
  selection.rules.rules = chosen.rules;
  selection.lacksPreset = preset == "auto" && chosen.surfaces.empty();
  if (chosen.removesTable)
  {
    selection.removesTable = true;
  }
  if (removesTable || keepsTable)
  {
    selection.removesTable = removesTable;
  }
  for (const std::string & text : surfaces)
  {
    selection.requests.push_back(ParseSurfaceRequest(text, selection.requests.size()));
  }
  if (further)
  {
    selection.requests.push_back(*further);
  }
  if (!labels.empty() || !probabilities.empty() || selection.requests.empty())
  {
    selection.labels = LabelSelection{
      { { labels.begin(), labels.end() }, labelTable, true, { probabilities.begin(), probabilities.end() } }, {}
    };
    selection.labels->source.namesMask = !leavesMaskUnnamed;
    for (const std::string & text : chosenLabels)
    {
      selection.rules.rules.push_back(ParseSceneRule(text));
      selection.labels->labels.push_back(selection.rules.rules.back().pattern);
    }
  }
  else if (!labelTable.empty() || !chosenLabels.empty())
  {
    throw Failure(
      FailureKind::Usage,
      "--label and --label-table are for label maps; name one with --labels, or leave out --preset, --surface and -t "
      "when SCAN is one.");
  }
  selection.rules = GetRules(std::move(selection.rules.rules));
  return selection;
}

SceneRules
SurfaceOptions::GetRules(std::vector<SceneRule> before) const
{
  SceneRules all;
  all.only = only;
  all.hidden = hidden;
  all.colours = FindNamed<LabelColours>(
    "colours",
    labelColours,
    { { "anatomy", LabelColours::Anatomy }, { "file", LabelColours::Table }, { "safe", LabelColours::ColourBlind } });
  all.rules = std::move(before);
  for (const std::string & text : looks)
  {
    all.rules.push_back(ParseSceneRule(text));
  }
  return all;
}

const SettingsTable<SurfaceFinish> &
FinishTable()
{
  static const SettingsTable<SurfaceFinish> table{
    { "--min-volume", &SurfaceFinish::minimumVolume, "remove connected parts of less than this, in ml" },
    { "--largest", &SurfaceFinish::keepsLargestPart, "keep the largest connected part of each surface only" },
    { "--fill", &SurfaceFinish::fillsCavities, "fill cavities: remove shells that lie inside others" },
    { "--smooth",
      &SurfaceFinish::smoothing,
      "smooth; no point moves further than this: 0.3 (spacings of the lattice) or 0.8mm, for example" },
  };
  return table;
}

const char *
GetColourByHelp()
{
  return "colour surfaces by numbers, with a bar in pictures; in PLY, VTP and GLB files of mesh: PET.nii.gz or a "
         "folder (the "
         "value of another volume there; a PET is in SUV, if DICOM says all that it needs), PET.nii.gz,max:5mm or "
         ",mean:5mm "
         "(of what lies so deep inwards), distance:OTHER.stl or distance:LABELS.nii.gz (signed distance to the surface "
         "of the same name, or to the only one), thickness (largest ball inside), curvature or curvature:3mm (mean "
         "curvature "
         "over so many mm); and perhaps the range and the map: pet.nii.gz,0,7,inferno (viridis, inferno, diverging)";
}

std::optional<ColourBy>
GetColourBy(const std::string & text)
{
  return text.empty() ? std::nullopt : std::optional(ParseColourBy(text));
}

} // namespace rhombic
