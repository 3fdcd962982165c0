#ifndef itkForEachSlab_h
#define itkForEachSlab_h

#include "itkProcessObject.h"
#include "itkWorkProgress.h"

#include <algorithm>

namespace itk
{

/** Calls work(begin, end) for slabs of the planes from 0 to \a planes - 1 as WorkProgress::ForEach() does. There are
 * about four slabs for each thread, of \a least to \a most planes: few planes keep threads busy, many save work at
 * their borders. */
template <typename TWork>
void
ForEachSlab(ProcessObject & filter, SizeValueType planes, SizeValueType least, SizeValueType most, const TWork & work)
{
  const SizeValueType units = std::max<SizeValueType>(1, filter.GetNumberOfWorkUnits());
  const SizeValueType planesPerSlab = std::clamp(planes / (4 * units), least, most);
  WorkProgress::ForEach(filter, (planes + planesPerSlab - 1) / planesPerSlab, [&](SizeValueType slab) {
    const SizeValueType begin = slab * planesPerSlab;
    work(begin, std::min(begin + planesPerSlab, planes));
  });
}

} // namespace itk

#endif
