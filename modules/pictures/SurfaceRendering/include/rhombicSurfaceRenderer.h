#ifndef rhombicSurfaceRenderer_h
#define rhombicSurfaceRenderer_h

#include "rhombicRenderBackend.h"
#include "rhombicScene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rhombic
{

/** \class SurfaceRenderer
 * \brief Draws surfaces, without a window and without an X server.
 *
 * The same scene and settings give the same bytes in every run on a machine, with any number of threads. After each
 * call the OpenGL context that was current on the thread, of EGL or GLX, is current again.
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

  /** Draws a scene from each view; the triangles are uploaded once. Surfaces without triangles are skipped, surfaces
   * without normals are drawn faceted. Of translucent surfaces only the near walls are drawn, more opaque at their
   * outlines. Translucent surfaces and planes are sorted by depth in each sample, up to 32 behind each other.
   *
   * Throws Failure: Empty when no surface has a triangle and there is no plane; Usage for a setting, colour, opacity,
   * cut or plane out of range; Memory when EstimateMemory() is more than the settings allow (before any work), or when
   * memory runs out; Display when the graphics library reports an error. */
  std::vector<RenderedView>
  Render(const Scene & scene, const RenderSettings & settings, const std::vector<View> & views);

  /** As Render(), but hands over each picture when it is drawn, on the calling thread: for many views whose pictures
   * need not be in memory together. What \a take throws ends the drawing; \a take must not draw. */
  void
  Render(const Scene & scene,
         const RenderSettings & settings,
         const std::vector<View> & views,
         const std::function<void(RenderedView)> & take);

  /** The pictures that Render() would make, without pixels: their projections, with a centre and pixel size that have
   * no meaning in perspective. Thread safe. Throws as Render() does for settings and surfaces. */
  static std::vector<Projection>
  Plan(const Scene & scene, const RenderSettings & settings, const std::vector<View> & views);

  /** Throws Failure(Usage) or Failure(Memory) where Render() would throw it because of the settings. Call it before
   * long work. The memory is that of a scene without triangles. \param isTranslucent whether the scene will have
   * translucent surfaces or planes, which take more memory */
  void
  CheckSettings(const RenderSettings & settings, bool isTranslucent = false) const;

  /** Throws Failure(Memory) where Render() would throw it for closed surfaces of so many triangles, else returns the
   * bytes that it needs. Thread safe. */
  static std::uintmax_t
  CheckMemory(const RenderSettings & settings, bool isTranslucent, double triangles);

  /** The largest number of bytes that Render() needs at a time with a software renderer for one view, including the
   * picture, excluding the scene. When it returns, the pictures and about 100 MiB of libraries stay in memory. Thread
   * safe. */
  static std::uintmax_t
  EstimateMemory(const Scene & scene, const RenderSettings & settings);

  /** One line: backend, renderer and OpenGL version. */
  std::string
  GetBackendDescription() const;

  /** Tries every backend, in the order of preference. Does not throw for a backend that does not work. */
  static std::vector<BackendProbe>
  ProbeBackends();

private:
  struct Implementation;
  std::unique_ptr<Implementation> m_Implementation;
};

} // namespace rhombic

#endif
