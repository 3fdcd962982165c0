#include "rhombicSurfaceOptions.h"

#include "rhombicDescribeScan.h"
#include "rhombicFailure.h"
#include "rhombicNamedValues.h"

namespace rhombic
{
namespace
{

itk::FCCIsosurfaceMode
ParseMode(const std::string & text)
{
  using Mode = itk::FCCIsosurfaceMode;
  static const NamedValues<Mode> modes{ { "lean", Mode::Lean },
                                        { "fine", Mode::Fine },
                                        { "tetrahedra", Mode::Tetrahedra },
                                        { "octahedra", Mode::Octahedra },
                                        { "parallelepipeds", Mode::Parallelepipeds } };
  return FindNamed("mode", text, modes);
}

LabelColours
ParseLabelColours(const std::string & text)
{
  static const NamedValues<LabelColours> colours{ { "anatomy", LabelColours::Anatomy },
                                                  { "file", LabelColours::Table },
                                                  { "safe", LabelColours::ColourBlind } };
  return FindNamed("colours", text, colours);
}

} // namespace

void
SurfaceOptions::Add(CLI::App & parser)
{
  parser.add_option("--preset",
                    m_Preset,
                    "surfaces by a preset's name, or by a .yaml file like those of the project; auto chooses one by "
                    "what the scan says and by its values");
  parser
    .add_option("--surface",
                m_Surfaces,
                "name=threshold[,colour[,opacity]]; colour: #rrggbb, #rgb or a name, as white; threshold: a number, "
                "<number for what lies below, otsu, otsu-low, otsu-lowest or otsu-high; repeatable")
    ->allow_extra_args(false);
  auto * const labels =
    parser
      .add_option(
        "--labels",
        m_Labels,
        "the surfaces of the scan's label map: NIfTI, NRRD, MetaImage or DICOM SEG, or a folder of masks (not "
        "needed when SCAN itself is one); repeatable, for several that are one segmentation")
      ->allow_extra_args(false);
  parser
    .add_option("--probabilities",
                m_Probabilities,
                "in place of --labels: a volume of probabilities of each label, or one file of several volumes; labels "
                "meet where they are equally probable; repeatable")
    ->excludes(labels)
    ->allow_extra_args(false);
  parser.add_option(
    "--label-table",
    m_LabelTable,
    "names and colours of labels (ITK-SNAP, Slicer, FreeSurfer, BIDS, nnU-Net, CSV; default: in or beside the map)");
  parser.add_flag("--unnamed-mask", m_LeavesMaskUnnamed, "do not call the label of a mask as its file")
    ->group(""); // batches set it, as the names of their files may be the patients'
  parser
    .add_option("--label",
                m_ChosenLabels,
                "one of the labels, by name (with * and ?) or value, and how to draw it: liver, 'rib*', "
                "liver=#994736,0.5; repeatable (default: all)")
    ->allow_extra_args(false);
  parser
    .add_option("--only",
                m_Only,
                "the surfaces and labels to show, by name with * and ?, or by group (group:bones, group:vessels, "
                "group:lungs, group:heart, "
                "group:brain, group:muscles, group:organs): 'liver,kidney*'; repeatable")
    ->delimiter(',')
    ->allow_extra_args(false);
  parser.add_option("--hide", m_Hidden, "surfaces and labels that are left out, as --only names them; repeatable")
    ->delimiter(',')
    ->allow_extra_args(false);
  parser
    .add_option("--draw",
                m_Rules,
                "colour, opacity and look (matte or glossy) of surfaces and labels by name or group: 'skin=,0.3', "
                "'group:bones=ivory', 'vessels=,,glossy'; repeatable, later ones count more")
    ->allow_extra_args(false);
  parser
    .add_option("--colours",
                m_LabelColours,
                "colours of labels: anatomy (for names that are known), file (those of the label table) or safe (for "
                "colour-blind people)")
    ->capture_default_str();
  auto * const removes =
    parser.add_flag("--remove-table",
                    m_RemovesTable,
                    "set table, head holder and sheets around the patient of a CT to air, as the ct- presets do");
  parser.add_flag("--keep-table", m_KeepsTable, "keep them although the preset removes them")->excludes(removes);
  parser
    .add_option(
      "--mode",
      m_Mode,
      "triangles: lean (a third to half as many as tetrahedra; on smooth surfaces well-shaped and as close as "
      "marching cubes), fine (closest to the truth), tetrahedra, octahedra or parallelepipeds")
    ->capture_default_str();
}

Preset
SurfaceOptions::GetNamedPreset() const
{
  return m_Preset.empty() || m_Preset == "auto" ? Preset() : FindPreset(m_Preset);
}

Preset
SurfaceOptions::GetPreset(ScanSource & source, const Events & events) const
{
  const std::string name =
    m_Preset == "auto" ? ChoosePreset(source, !m_Labels.empty() || !m_Probabilities.empty(), events) : m_Preset;
  return name.empty() ? Preset() : FindPreset(name);
}

SurfaceSelection
SurfaceOptions::GetSelection(const Preset & preset, const std::optional<SurfaceRequest> & further) const
{
  SurfaceSelection selection;
  selection.mode = ParseMode(m_Mode);
  selection.requests = preset.surfaces;
  selection.rules.rules = preset.rules;
  selection.lacksPreset = m_Preset == "auto" && preset.surfaces.empty();
  if (preset.removesTable)
  {
    selection.removesTable = true;
  }
  if (m_RemovesTable || m_KeepsTable)
  {
    selection.removesTable = m_RemovesTable;
  }
  for (const std::string & text : m_Surfaces)
  {
    selection.requests.push_back(ParseSurfaceRequest(text, selection.requests.size()));
  }
  if (further)
  {
    selection.requests.push_back(*further);
  }
  if (!m_Labels.empty() || !m_Probabilities.empty() || selection.requests.empty())
  {
    selection.labels = LabelSelection{
      { { m_Labels.begin(), m_Labels.end() }, m_LabelTable, true, { m_Probabilities.begin(), m_Probabilities.end() } },
      {}
    };
    selection.labels->source.namesMask = !m_LeavesMaskUnnamed;
    for (const std::string & text : m_ChosenLabels)
    {
      selection.rules.rules.push_back(ParseSceneRule(text));
      selection.labels->labels.push_back(selection.rules.rules.back().pattern);
    }
  }
  else if (!m_LabelTable.empty() || !m_ChosenLabels.empty())
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
  SceneRules rules;
  rules.only = m_Only;
  rules.hidden = m_Hidden;
  rules.colours = ParseLabelColours(m_LabelColours);
  rules.rules = std::move(before);
  for (const std::string & text : m_Rules)
  {
    rules.rules.push_back(ParseSceneRule(text));
  }
  return rules;
}

} // namespace rhombic
