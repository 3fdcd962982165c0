#include "vtkRhombicMessages.h"

#include <vtkObjectFactory.h>

#include <sstream>

vtkStandardNewMacro(vtkRhombicMessages);

namespace
{

/** VTK writes "ERROR: In <file>, line <n>\n<class> (<address>): <message>\n\n"; this is the message alone. */
std::string
MessageOf(const char * text)
{
  std::string message;
  std::istringstream lines(text);
  std::getline(lines, message);
  std::getline(lines, message);
  const auto start = message.find("): ");
  return start == std::string::npos ? message : message.substr(start + 3);
}

} // namespace

void
vtkRhombicMessages::DisplayText(const char * text)
{
  if (std::this_thread::get_id() != m_Thread)
  {
    m_Previous->DisplayText(text);
  }
  else if (this->GetCurrentMessageType() == MESSAGE_TYPE_ERROR && m_FirstError.empty())
  {
    m_FirstError = MessageOf(text);
  }
}

vtkRhombicMessages::Scope::Scope()
  : m_Messages(vtkSmartPointer<vtkRhombicMessages>::New())
  , m_PreviousVerbosity(vtkLogger::GetCurrentVerbosityCutoff())
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  m_Messages->m_Previous = vtkOutputWindow::GetInstance();
  vtkOutputWindow::SetInstance(m_Messages);
}

vtkRhombicMessages::Scope::~Scope()
{
  vtkOutputWindow::SetInstance(m_Messages->m_Previous);
  vtkLogger::SetStderrVerbosity(m_PreviousVerbosity);
}
