#ifndef itkRowRing_h
#define itkRowRing_h

#include "itkIntTypes.h"

#include <algorithm>
#include <vector>

namespace itk
{

/** A ring of float rows for a pass that moves on along an axis. Row n is kept at index n modulo the number of rows,
 * until a later row overwrites it. */
class RowRing
{
public:
  /** \param length of a row, in samples */
  RowRing(SizeValueType numberOfRows, SizeValueType length)
    : m_NumberOfRows(numberOfRows)
    , m_Length(length)
    , m_Samples(numberOfRows * length)
  {}

  float *
  GetRow(SizeValueType n)
  {
    return m_Samples.data() + n % m_NumberOfRows * m_Length;
  }

  /** Calls make(n, GetRow(n)) for the rows from \a first to before \a end that were not made since Restart(). From call
   * to call, \a first and \a end do not decrease. */
  template <typename TMake>
  void
  Advance(SizeValueType first, SizeValueType end, const TMake & make)
  {
    for (m_Next = std::max(m_Next, first); m_Next < end; ++m_Next)
    {
      make(m_Next, this->GetRow(m_Next));
    }
  }

  /** Begins a new pass from the axis' first row. */
  void
  Restart()
  {
    m_Next = 0;
  }

private:
  SizeValueType m_NumberOfRows;
  SizeValueType m_Length;
  SizeValueType m_Next = 0;
  std::vector<float> m_Samples;
};

/** How many of \a numberOfRows output rows to work on at a time, such that the intermediate samples, so many for each
 * row, stay in a processor's second-level cache. At least 8. */
inline SizeValueType
RowsPerBlock(SizeValueType samplesPerRow, SizeValueType numberOfRows)
{
  constexpr SizeValueType cachedSamples = 256 * 1024;
  return std::clamp<SizeValueType>(cachedSamples / samplesPerRow, 8, std::max<SizeValueType>(8, numberOfRows));
}

} // namespace itk

#endif
