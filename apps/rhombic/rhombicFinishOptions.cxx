#include "rhombicFinishOptions.h"

namespace rhombic
{

void
FinishOptions::Add(CLI::App & parser)
{
  parser.add_option("--min-volume", m_Finish.minimumVolume, "remove connected parts of less than this, in ml");
  parser.add_flag("--largest", m_Finish.keepsLargestPart, "keep the largest connected part of each surface only");
  parser.add_flag("--fill", m_Finish.fillsCavities, "fill cavities: remove shells that lie inside others");
  parser.add_option(
    "--smooth", m_Finish.smoothing, "smooth; no point moves further than this many spacings of the lattice, as 0.3");
}

SurfaceFinish
FinishOptions::Get() const
{
  CheckSurfaceFinish(m_Finish);
  return m_Finish;
}

} // namespace rhombic
