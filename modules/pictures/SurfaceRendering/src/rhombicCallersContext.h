#ifndef rhombicCallersContext_h
#define rhombicCallersContext_h

#include <memory>

namespace rhombic
{

/** \class CallersContext
 * \brief Keeps what is current for OpenGL on this thread, of EGL or GLX, and makes it current again when destroyed.
 *
 * Meanwhile nothing of GLX is current, so that a context of EGL can be. */
class CallersContext
{
public:
  CallersContext();
  ~CallersContext();

  CallersContext(const CallersContext &) = delete;
  CallersContext &
  operator=(const CallersContext &) = delete;

private:
  struct State;
  std::unique_ptr<const State> m_State;
};

} // namespace rhombic

#endif
