#ifndef rhombicMemoryPlan_h
#define rhombicMemoryPlan_h

#include "rhombicEvents.h"
#include "rhombicMeshScan.h"
#include "rhombicResampleScan.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace rhombic
{

/** \file
 * What long work would take, found from the headers of a scan and, where it can be read in part, from some of its
 * slices, within seconds. Nothing is written. The texts are lines for a person: where the voxels will be, the lattice
 * and its slabs, surfaces and files, memory and time. Triangles and time are estimates, which noise and other programs
 * change. All throw Failure as the work itself would before it begins, Memory for what does not fit. */

/** MeshScan(). Surfaces are estimated for isovalues, and Otsu's threshold for those slices, and those of labels, whose
 * map is read. */
std::string
PlanMeshScan(const MeshScanSettings & settings, const Events & events);

/** Finds the part of labels that pictures need, as LabelSurfaceSettings::part. */
using FindPart = std::function<std::optional<itk::ImageRegion<3>>(const LoadedSource & loaded)>;

/** Surfaces of a scan that are drawn, as PlanMeshScan(). */
std::string
PlanPictures(const SurfaceWork & work,
             const CountDrawing & countDrawing,
             const FindPart & findPart,
             const std::filesystem::path & picture,
             const Events & events);

/** ResampleScan(). */
std::string
PlanResampleScan(const ResampleScanSettings & settings, const Events & events);

} // namespace rhombic

#endif
