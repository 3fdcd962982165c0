#ifndef vtkRhombicHeadlessRenderWindow_h
#define vtkRhombicHeadlessRenderWindow_h

#include "rhombicRenderBackend.h"

#include <vtkOpenGLRenderWindow.h>

#include <memory>
#include <vector>

/** \class vtkRhombicHeadlessRenderWindow
 * \brief A vtkRenderWindow without a screen, on EGL, for programs that run without an X server.
 *
 * Create it with New() where a program has vtkRenderWindow::New(), which makes a vtkXOpenGLRenderWindow. It draws what
 * that window draws, into buffers of its own: read them by vtkWindowToImageFilter or GetPixelData(). The default size
 * is 300 x 300 pixels. A graphics card is used if there is one, otherwise Mesa's software renderer.
 *
 * Errors: the window never aborts a program. SupportsOpenGL() returns 0 where nothing can be drawn, and
 * GetOpenGLSupportMessage() then tells in one sentence why, and what to install. Render() reports the same sentence as
 * an error of VTK (vtkCommand::ErrorEvent) and draws nothing; methods that read pixels return VTK_ERROR.
 *
 * Current context: as in other windows of VTK, Render(), Initialize(), MakeCurrent() and methods that read pixels make
 * the window's OpenGL context current on the thread, in place of any other context of EGL or GLX, and it stays so.
 * After SupportsOpenGL(), ProbeBackends(), PopContext(), Finalize() and the destructor, the context is current that was
 * current before. Where other contexts are used on the same thread, as those of VTK's windows of GLX, call
 * PushContext() and PopContext() around the use of this window, or ReleaseCurrent() after it.
 *
 * Thread safety: VTK's functions of OpenGL are one table in a process, so use one window at a time. A window may be
 * used by one thread after the other, if each calls ReleaseCurrent() at its end. */
class vtkRhombicHeadlessRenderWindow : public vtkOpenGLRenderWindow
{
public:
  static vtkRhombicHeadlessRenderWindow *
  New();
  vtkTypeMacro(vtkRhombicHeadlessRenderWindow, vtkOpenGLRenderWindow);
  void
  PrintSelf(ostream & os, vtkIndent indent) override;

  /** Where the OpenGL context comes from: rhombic::RenderBackend::Automatic by default. A change takes effect when
   * there is no context: before the first picture, or after Finalize(). */
  vtkSetEnumMacro(Backend, rhombic::RenderBackend);
  vtkGetEnumMacro(Backend, rhombic::RenderBackend);

  /** Tries every backend, in the order of preference, and keeps none of their contexts. Reports no errors. */
  static std::vector<rhombic::BackendProbe>
  ProbeBackends();

  /** Whether the window can draw, 1 or 0. If there is no OpenGL context yet, one is created and kept. Reports no
   * errors; GetOpenGLSupportMessage() then is a line with backend, renderer and OpenGL version, or the reason why not.
   */
  int
  SupportsOpenGL() override;

  /** Creates the OpenGL context if there is none, and makes it current. */
  void
  Initialize() override;

  /** Frees the OpenGL context and all that has been uploaded to it. The next Render() starts with a new one. */
  void
  Finalize() override;

  void
  Render() override;

  /** Makes the window's OpenGL context current on this thread. Does nothing if there is none yet. */
  void
  MakeCurrent() override;

  /** Does nothing if another context is current on this thread. */
  void
  ReleaseCurrent() override;

  /** Whether the window's OpenGL context is current on this thread. */
  bool
  IsCurrent() override;

  /** Keeps the context that is current on this thread until PopContext(), and makes the window's context current. */
  void
  PushContext() override;
  void
  PopContext() override;

  /** Reports an error of OpenGL, whose context is current, as an error of VTK. Throws std::bad_alloc if memory has run
   * out.
   */
  void
  CheckErrors();

  /** The part of GLEW's work that needs no display. */
  void
  OpenGLInitContext() override;

  using vtkOpenGLRenderWindow::GetZbufferData;
  int
  GetZbufferData(int x1, int y1, int x2, int y2, float * z) override;
  const char *
  ReportCapabilities() override;

  /** The EGLDisplay. All users of a display in a process share it, so it is never terminated. */
  void *
  GetGenericDisplayId() override;
  /** The EGLContext. */
  void *
  GetGenericContext() override;

  // clang-format off
  vtkTypeBool IsDirect() override { return 1; }
  /** What a screen would have: 1920 x 1080 pixels. */
  int * GetScreenSize() override { return this->ScreenSize; }
  vtkTypeBool GetEventPending() override { return 0; }

  /** There is no window of the operating system. */
  void * GetGenericWindowId() override { return nullptr; }
  void * GetGenericParentId() override { return nullptr; }
  void * GetGenericDrawable() override { return nullptr; }
  void SetDisplayId(void *) override {}
  void SetWindowId(void *) override {}
  void SetNextWindowId(void *) override {}
  void SetParentId(void *) override {}
  void SetWindowInfo(const char *) override {}
  void SetNextWindowInfo(const char *) override {}
  void SetParentInfo(const char *) override {}
  void SetFullScreen(vtkTypeBool) override {}
  void WindowRemap() override {}
  void HideCursor() override {}
  void ShowCursor() override {}
  // clang-format on

  vtkRhombicHeadlessRenderWindow(const vtkRhombicHeadlessRenderWindow &) = delete;
  void
  operator=(const vtkRhombicHeadlessRenderWindow &) = delete;

protected:
  vtkRhombicHeadlessRenderWindow();
  ~vtkRhombicHeadlessRenderWindow() override;

  int
  ReadPixels(const vtkRecti & rect, int front, int glFormat, int glType, void * data, int right) override;

  // clang-format off
  void CreateAWindow() override {}
  void DestroyWindow() override {}
  // clang-format on

private:
  /** Makes the window's context current, and ready to draw. If that fails, OpenGLSupportMessage is the reason. */
  bool
  Prepare();

  struct vtkInternals;
  const std::unique_ptr<vtkInternals> Internals;
  rhombic::RenderBackend Backend = rhombic::RenderBackend::Automatic;
};

#endif
