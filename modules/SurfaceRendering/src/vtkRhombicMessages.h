#ifndef vtkRhombicMessages_h
#define vtkRhombicMessages_h

#include <vtkLogger.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <string>
#include <thread>

/** \class vtkRhombicMessages
 * \brief Keeps what VTK would print from this thread, as long as a vtkRhombicMessages::Scope lives.
 *
 * Messages of other threads go to the window where they went before. VTK also logs errors to the terminal, beside its
 * window; meanwhile it does not, in any thread. */
class vtkRhombicMessages : public vtkOutputWindow
{
public:
  vtkTypeMacro(vtkRhombicMessages, vtkOutputWindow);
  static vtkRhombicMessages *
  New();

  void
  DisplayText(const char * text) override;

  /** The first error, without VTK's decoration, or nothing. */
  const std::string &
  GetFirstError() const
  {
    return m_FirstError;
  }

  class Scope;

private:
  vtkSmartPointer<vtkOutputWindow> m_Previous;
  std::thread::id m_Thread = std::this_thread::get_id();
  std::string m_FirstError;
};

class vtkRhombicMessages::Scope
{
public:
  Scope();
  ~Scope();

  Scope(const Scope &) = delete;
  Scope &
  operator=(const Scope &) = delete;

  const std::string &
  GetFirstError() const
  {
    return m_Messages->GetFirstError();
  }

private:
  vtkSmartPointer<vtkRhombicMessages> m_Messages;
  vtkLogger::Verbosity m_PreviousVerbosity;
};

#endif
