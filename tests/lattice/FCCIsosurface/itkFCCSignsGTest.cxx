#include "itkFCCSigns.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include <unistd.h>

namespace
{

/** Memory of this process in bytes. */
std::size_t
FindResidentMemory()
{
  std::size_t size = 0;
  std::size_t resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

} // namespace

TEST(FCCSigns, PagesWithoutASiteInsideTakeNoMemory)
{
  [[maybe_unused]] const std::size_t before = FindResidentMemory();
  itk::FCCSigns signs(2000, 2000, 2000, 0); // 1 GB
  const std::vector<itk::FCCSigns::WordType> none(signs.GetNumberOfWords(), 0);
  std::vector<itk::FCCSigns::WordType> some = none;
  some[7] = 5;
  for (itk::SizeValueType k = 0; k < 2000; ++k)
  {
    for (itk::SizeValueType j = 0; j < 2000; ++j)
    {
      signs.SetRow(j, k, k == 1000 && j % 2 == 0 ? some.data() : none.data());
    }
  }
  itk::SizeValueType inside = 0;
  for (itk::SizeValueType k = 0; k < 2000; ++k)
  {
    for (itk::SizeValueType j = 0; j < 2000; ++j)
    {
      for (itk::SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
      {
        inside += itk::FCCBits::Count(signs.GetRow(j, k)[word]);
      }
    }
  }
  EXPECT_EQ(inside, 2000u);
  EXPECT_EQ(signs.GetRow(8, 1000)[7], 5u);
#ifndef __SANITIZE_THREAD__ // which keeps notes of all that is looked at
  EXPECT_LT(FindResidentMemory(), before + 32'000'000) << "one plane has 512 kB";
#endif
}
