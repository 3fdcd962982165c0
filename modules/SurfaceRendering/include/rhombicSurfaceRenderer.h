#ifndef rhombicSurfaceRenderer_h
#define rhombicSurfaceRenderer_h

#include "rhombicPicture.h"
#include "rhombicRenderBackend.h"
#include "rhombicScene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rhombic
{

/** \class SurfaceRenderer
 * \brief Draws surfaces, without a window and without an X server.
 *
 * The same scene and settings give the same bytes in every run on a machine, with any number of threads.
 *
 * Thread safety: create, use and destroy a renderer on one thread. Each thread may have its own; only one of them draws
 * at a time.
 */
class SurfaceRenderer
{
public:
  /** Throws Failure(Display) when the backend does not work on this machine. */
  explicit SurfaceRenderer(RenderBackend backend = RenderBackend::Automatic);
  ~SurfaceRenderer();

  SurfaceRenderer(const SurfaceRenderer &) = delete;
  SurfaceRenderer &
  operator=(const SurfaceRenderer &) = delete;

  /** Draws all surfaces, as large as fits between the picture's margins. Surfaces without triangles are skipped.
   * Surfaces without normals are drawn faceted. Of translucent surfaces only the near walls are drawn, more opaque at
   * their outlines, sorted by depth.
   *
   * Throws Failure: Empty when no surface has a triangle; Usage for a setting, colour or opacity out of range; Memory
   * when EstimateMemory() is more than the settings allow (before any work), or when memory runs out; Display when the
   * graphics library reports an error. */
  Picture
  Render(const std::vector<SceneSurface> & scene, const RenderSettings & settings);

  /** Throws Failure(Usage) or Failure(Memory) where Render() would throw it because of the settings. Call it before
   * long work. The memory is that of a scene without triangles. \param isTranslucent whether the scene will have
   * translucent surfaces, which take more memory */
  void
  CheckSettings(const RenderSettings & settings, bool isTranslucent = false) const;

  /** The largest number of bytes that Render() needs at a time with a software renderer, including the picture,
   * excluding the surfaces. When it returns, the picture and about 100 MiB of libraries stay in memory. Thread safe. */
  static std::uintmax_t
  EstimateMemory(const std::vector<SceneSurface> & scene, const RenderSettings & settings);

  /** One line: backend, renderer and OpenGL version. */
  std::string
  GetBackendDescription() const;

  /** Tries every backend, in the order of preference. Does not throw for a backend that does not work. */
  static std::vector<BackendProbe>
  ProbeBackends();

private:
  class Implementation;
  std::unique_ptr<Implementation> m_Implementation;
};

} // namespace rhombic

#endif
