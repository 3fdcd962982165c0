#ifndef rhombicSurfaceMemory_h
#define rhombicSurfaceMemory_h

#include "rhombicBulkMemory.h"
#include "rhombicColourBy.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicMeshEstimate.h"
#include "rhombicScanSource.h"
#include "rhombicSurfaceFinish.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace rhombic
{

/** \file
 * Surfaces of a source that the memory allowed can't hold: their arrays are in temporary files. Files and pictures have
 * the same bytes then. */

/** What surfaces are made of, and what is done to them. All references must outlive the object. */
struct SurfaceWork
{
  const ScanSource & source;
  const SurfaceSelection & surfaces;
  const SurfaceFinish & finish;
  const std::optional<ColourBy> & colourBy;
  bool audits = false; ///< whether all triangles of the written surface are searched for crossings
};

/** The bytes that all may take, and surfaces: without a limit all that is free; 4 MiB and more, less than which the
 * program itself takes. */
std::uintmax_t
AllowedBytes(const ScanSource & source);

/** The steps of the isosurfaces. */
MeshSteps
FindSteps(const SurfaceWork & work);

/** Counts the steps of isosurfaces, and plans temporary files for those that the memory can't hold. Throws
 * Failure(Memory) where there is no room for them. Those of parts that need the whole lattice stay in memory, as those
 * of a denoised scan, which may be far smaller, do without room. */
void
FitIntoMemory(MeshEstimate & mesh, const SurfaceWork & work);

/** The same for labels. Returns whether they are in temporary files. Throws Failure(Memory) also where probabilities,
 * or colours by a label map, need memory. */
bool
FitIntoMemory(LabelWork & labels, const SurfaceWork & work);

/** What colours come from, while surfaces are in temporary files. */
ColourBy
WithinMemory(ColourBy by, const ScanSource & source);

/** Triangles of surfaces in a picture. */
struct DrawnTriangles
{
  double least = 0.0;
  double likely = 0.0;
};

/** Returns the bytes that the largest picture likely takes. Throws Failure(Memory) where the least is too much. Empty
 * where nothing is drawn. */
using CountDrawing = std::function<std::uintmax_t(const DrawnTriangles & triangles)>;

/** FitIntoMemory() of surfaces that are drawn. Throws Failure(Memory) for surfaces that neither the memory nor
 * temporary files can hold, and for too large pictures of them. Of denoised surfaces, and of those of which parts are
 * removed, the triangles are not known. Returns the bytes of the largest picture. */
std::uintmax_t
FitDrawn(MeshEstimate & mesh, const SurfaceWork & work, const CountDrawing & countDrawing);

/** The same for labels. \param isInFiles is set */
std::uintmax_t
FitDrawn(LabelWork & labels, const SurfaceWork & work, const CountDrawing & countDrawing, bool & isInFiles);

/** What is to be said of a picture that likely takes more than is allowed; else empty. */
std::string
DoubtDrawing(std::uintmax_t bytes, const ScanSource & source);

/** \class SurfacesInFiles
 * \brief From a call of Put() on, arrays are in temporary files; a note says so. */
class SurfacesInFiles
{
public:
  /** Does nothing for surfaces that are planned in memory. */
  void
  Put(const MeshEstimate & mesh, const ScanSource & source, const Events & events);

  /** Labels are always put there. */
  void
  Put(const LabelWork & labels, const ScanSource & source, const Events & events);

  bool
  IsUsed() const
  {
    return m_Files.has_value();
  }

private:
  std::optional<BulkInTemporaryFiles> m_Files;
};

} // namespace rhombic

#endif
