#include "rhombicSurfaceOptions.h"

#include "rhombicFailure.h"
#include "rhombicNamedValues.h"
#include "rhombicPresets.h"

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

} // namespace

void
SurfaceOptions::Add(CLI::App & parser)
{
  parser.add_option("--preset", m_Preset, "surfaces by a preset's name, or by a .yaml file like those of the project");
  parser
    .add_option("--surface",
                m_Surfaces,
                "name=threshold[,colour[,opacity]]; colour: #rrggbb, #rgb or a name, as white; threshold: a number, "
                "<number for what lies below, or otsu; repeatable")
    ->allow_extra_args(false);
  parser.add_option("--labels",
                    m_Labels,
                    "the surfaces of the scan's label map: NIfTI, NRRD, MetaImage or DICOM SEG (not needed when SCAN "
                    "itself is a label map)");
  parser.add_option("--label-table",
                    m_LabelTable,
                    "names and colours of labels (ITK-SNAP, Slicer, FreeSurfer, BIDS; default: in or beside the map)");
  parser.add_option("--label", m_ChosenLabels, "one of the labels, by name or value; repeatable (default: all)")
    ->allow_extra_args(false);
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

SurfaceSelection
SurfaceOptions::GetSelection(const std::optional<SurfaceRequest> & further) const
{
  SurfaceSelection selection;
  selection.mode = ParseMode(m_Mode);
  if (!m_Preset.empty())
  {
    const Preset preset = FindPreset(m_Preset);
    selection.requests = preset.surfaces;
    if (preset.removesTable)
    {
      selection.removesTable = true;
    }
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
  if (!m_Labels.empty() || selection.requests.empty())
  {
    selection.labels = LabelSelection{ { m_Labels, m_LabelTable }, m_ChosenLabels };
  }
  else if (!m_LabelTable.empty() || !m_ChosenLabels.empty())
  {
    throw Failure(FailureKind::Usage,
                  "--label and --label-table are for label maps; name one with --labels, or leave out --preset, "
                  "--surface and -t when SCAN is one.");
  }
  return selection;
}

} // namespace rhombic
