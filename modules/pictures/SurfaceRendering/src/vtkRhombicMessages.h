#ifndef vtkRhombicMessages_h
#define vtkRhombicMessages_h

#include <vtkLogger.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <string>
#include <thread>

/** \class vtkRhombicMessages
 * \brief Catches the messages of VTK on this thread during the lifetime of a vtkRhombicMessages::Scope.
 *
 * Messages of other threads go to VTK's previous message window. VTK's log of errors on the terminal is off for all
 * threads meanwhile. */
class vtkRhombicMessages : public vtkOutputWindow
{
public:
  vtkTypeMacro(vtkRhombicMessages, vtkOutputWindow);
  static vtkRhombicMessages *
  New();

  void
  DisplayText(const char * text) override;

  /** The first error, without file, line and class, or an empty string. */
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
