#ifndef rhombicQuietVTK_h
#define rhombicQuietVTK_h

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>

namespace rhombic
{

/** Keeps a VTK algorithm's errors and warnings off the terminal: VTK prints only those that nobody observes. */
inline void
Silence(vtkAlgorithm & algorithm)
{
  vtkNew<vtkCallbackCommand> listener; // without a callback: it hears and does nothing
  for (vtkObject * const object :
       { static_cast<vtkObject *>(&algorithm), static_cast<vtkObject *>(algorithm.GetExecutive()) })
  {
    object->AddObserver(vtkCommand::ErrorEvent, listener);
    object->AddObserver(vtkCommand::WarningEvent, listener);
  }
}

} // namespace rhombic

#endif
