#include "rhombicScanOptions.h"

#include "rhombicFailure.h"

#include <charconv>
#include <map>

namespace rhombic
{
namespace
{

/** One number for all axes, or three separated by commas. */
std::array<double, 3>
ParseSpacing(const std::string & text)
{
  std::array<double, 3> spacing{};
  if (text.empty())
  {
    return spacing;
  }
  std::size_t count = 0;
  const char * next = text.data();
  const char * end = next + text.size();
  while (count < 3)
  {
    const auto parsed = std::from_chars(next, end, spacing[count]);
    if (parsed.ec != std::errc() || !(spacing[count] > 0.0))
    {
      break;
    }
    ++count;
    next = parsed.ptr;
    if (next == end || *next != ',')
    {
      break;
    }
    ++next;
  }
  if (next != end || (count != 1 && count != 3))
  {
    throw Failure(FailureKind::Usage,
                  "The spacing '" + text +
                    "' is neither one positive number nor three; write --spacing 1.5 or 1,1,2 (mm).");
  }
  return count == 1 ? std::array<double, 3>{ spacing[0], spacing[0], spacing[0] } : spacing;
}

} // namespace

void
ScanOptions::AddSource(CLI::App & parser)
{
  parser.add_option("SCAN", m_Path, "DICOM folder, or NIfTI, NRRD or MetaImage file, or a lattice volume (.fcc.nrrd)");
  parser.add_option(
    "--series", m_Series, "which DICOM series: id, UID, place in the list or SeriesNumber (default: most slices)");
}

void
ScanOptions::AddLattice(CLI::App & parser)
{
  CLI::Option * const density =
    parser
      .add_option(
        "--density",
        m_Density,
        "lattice sites per sample of the scan (this and the next three: without effect when SCAN is a lattice volume)")
      ->capture_default_str();
  CLI::Option * const spacing =
    parser.add_option("--spacing", m_Spacing, "lattice spacing in mm, one number or x,y,z, instead of a density");
  CLI::Option * const kernel =
    parser
      .add_option("--kernel", m_Kernel, "how values between samples are computed: cubic (B-spline), linear or lanczos")
      ->capture_default_str();
  parser
    .add_flag("--nested",
              m_Nested,
              "instead: every other sample of the scan, without interpolation, after a half-band filter; density 0.5")
    ->excludes(density)
    ->excludes(spacing)
    ->excludes(kernel);
}

void
ScanOptions::AddExtraction(CLI::App & parser)
{
  parser
    .add_option(
      "--mode",
      m_Mode,
      "triangles: lean (a third to half as many as tetrahedra; on smooth surfaces well-shaped and as close as "
      "marching cubes), fine (closest to the truth), tetrahedra, octahedra or parallelepipeds")
    ->capture_default_str();
}

itk::FCCIsosurfaceMode
ScanOptions::GetMode() const
{
  using Mode = itk::FCCIsosurfaceMode;
  static const std::map<std::string, Mode> modes{ { "lean", Mode::Lean },
                                                  { "fine", Mode::Fine },
                                                  { "tetrahedra", Mode::Tetrahedra },
                                                  { "octahedra", Mode::Octahedra },
                                                  { "parallelepipeds", Mode::Parallelepipeds } };
  const auto mode = modes.find(m_Mode);
  if (mode == modes.end())
  {
    throw Failure(FailureKind::Usage,
                  "There is no mode '" + m_Mode + "'; use lean, fine, tetrahedra, octahedra or parallelepipeds.");
  }
  return mode->second;
}

ScanSource
ScanOptions::GetSource() const
{
  static const std::map<std::string, itk::SeparableKernel> kernels{ { "cubic", itk::SeparableKernel::CubicBSpline },
                                                                    { "linear", itk::SeparableKernel::Linear },
                                                                    { "lanczos", itk::SeparableKernel::Lanczos4 } };
  if (m_Path.empty())
  {
    throw Failure(FailureKind::Usage, "No scan is given; name a DICOM folder or a volume file (see --help).");
  }
  const auto kernel = kernels.find(m_Kernel);
  if (kernel == kernels.end())
  {
    throw Failure(FailureKind::Usage, "There is no kernel '" + m_Kernel + "'; use cubic, linear or lanczos.");
  }
  ScanSource source;
  source.path = m_Path;
  source.read.series = m_Series;
  source.lattice.density = m_Density;
  source.lattice.spacing = ParseSpacing(m_Spacing);
  source.lattice.kernel = kernel->second;
  source.lattice.nested = m_Nested;
  return source;
}

} // namespace rhombic
