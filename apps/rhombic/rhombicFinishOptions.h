#ifndef rhombicFinishOptions_h
#define rhombicFinishOptions_h

#include "rhombicSurfaceFinish.h"

#include <CLI/CLI.hpp>

namespace rhombic
{

/** \class FinishOptions
 * \brief The options of several commands for parts and smoothness of surfaces. */
class FinishOptions
{
public:
  void
  Add(CLI::App & parser);

  /** Throws Failure(Usage) for values out of range. */
  SurfaceFinish
  Get() const;

private:
  SurfaceFinish m_Finish;
};

} // namespace rhombic

#endif
