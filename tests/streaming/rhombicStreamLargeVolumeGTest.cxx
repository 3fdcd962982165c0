#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

using Path = std::filesystem::path;

/** A file that goes away with the object. */
class TemporaryFile
{
public:
  explicit TemporaryFile(const std::string & name)
    : m_Path(Path(RHOMBIC_STREAMING_FOLDER) / (std::to_string(getpid()) + "-" + name))
  {}
  ~TemporaryFile()
  {
    std::error_code ignored;
    std::filesystem::remove(m_Path, ignored);
  }
  TemporaryFile(const TemporaryFile &) = delete;
  TemporaryFile &
  operator=(const TemporaryFile &) = delete;

  const Path &
  GetPath() const
  {
    return m_Path;
  }

private:
  Path m_Path;
};

/** Writes an uncompressed MetaImage of int16, \a size samples of 1 mm along each axis, plane by plane: three blobs that
 * rise to 1000 and touch each other, with waves on them. Product terms, so that a sample costs little. */
void
WriteBlobs(const Path & path, std::size_t size)
{
  std::ofstream file(path, std::ios::binary);
  file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
       << "DimSize = " << size << ' ' << size << ' ' << size
       << "\nElementSpacing = 1 1 1\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  constexpr std::size_t terms = 4;
  static constexpr float centers[3][3] = { { 0.35f, 0.4f, 0.3f }, { 0.6f, 0.55f, 0.5f }, { 0.4f, 0.6f, 0.75f } };
  const auto termAt = [size](std::size_t term, std::size_t axis, std::size_t n) {
    const float place = static_cast<float>(n) / static_cast<float>(size);
    if (term == 3)
    {
      return std::sin(60.0f * place + static_cast<float>(axis)) * (axis == 0 ? 60.0f : 1.0f);
    }
    const float distance = (place - centers[term][axis]) / 0.15f;
    return std::exp(-distance * distance) * (axis == 0 ? 1000.0f : 1.0f);
  };
  std::vector<float> along[terms];
  for (std::size_t term = 0; term < terms; ++term)
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      along[term].push_back(termAt(term, 0, i));
    }
  }
  std::vector<std::int16_t> plane(size * size);
  for (std::size_t k = 0; k < size; ++k)
  {
    for (std::size_t j = 0; j < size; ++j)
    {
      float weights[terms];
      for (std::size_t term = 0; term < terms; ++term)
      {
        weights[term] = termAt(term, 1, j) * termAt(term, 2, k);
      }
      for (std::size_t i = 0; i < size; ++i)
      {
        plane[j * size + i] = static_cast<std::int16_t>(weights[0] * along[0][i] + weights[1] * along[1][i] +
                                                        weights[2] * along[2][i] + weights[3] * along[3][i]);
      }
    }
    file.write(reinterpret_cast<const char *>(plane.data()), static_cast<std::streamsize>(2 * plane.size()));
  }
  file.close();
  ASSERT_TRUE(file) << "can't write " << path;
}

struct Outcome
{
  int status;
  double peakMiB; ///< the most resident memory
};

/** Runs the example on a volume. */
Outcome
StreamLargeVolume(const Path & volume, unsigned int slabs, const Path & surface, unsigned int threads)
{
  const std::string program = Path(RHOMBIC_PROGRAM_FOLDER) / "StreamLargeVolume";
  const std::string count = std::to_string(slabs);
  const std::string threadCount = std::to_string(threads);
  const pid_t child = fork();
  if (child == 0)
  {
    setenv("ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS", threadCount.c_str(), 1);
    execl(program.c_str(), program.c_str(), volume.c_str(), "500.5", count.c_str(), surface.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  return { status, static_cast<double>(usage.ru_maxrss) / 1024.0 };
}

std::string
ReadBytes(const Path & path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

TEST(StreamLargeVolume, TheMeshFileIsTheSameAsFromMemory)
{
  const TemporaryFile volume("256.mha");
  const TemporaryFile whole("whole.stl");
  const TemporaryFile streamed("streamed.stl");
  ASSERT_NO_FATAL_FAILURE(WriteBlobs(volume.GetPath(), 256));
  EXPECT_EQ(StreamLargeVolume(volume.GetPath(), 1, whole.GetPath(), 2).status, 0);
  EXPECT_EQ(StreamLargeVolume(volume.GetPath(), 11, streamed.GetPath(), 5).status, 0);
  const std::string bytes = ReadBytes(streamed.GetPath());
  EXPECT_GT(bytes.size(), 1u << 20);
  EXPECT_TRUE(bytes == ReadBytes(whole.GetPath()));
}

TEST(StreamLargeVolume, MemoryHardlyGrowsWithTheThreads)
{
  const TemporaryFile volume("512.mha");
  const TemporaryFile surface("512.stl");
  ASSERT_NO_FATAL_FAILURE(WriteBlobs(volume.GetPath(), 512));
  const Outcome two = StreamLargeVolume(volume.GetPath(), 32, surface.GetPath(), 2);
  const Outcome many = StreamLargeVolume(volume.GetPath(), 32, surface.GetPath(), 24);
  EXPECT_EQ(two.status, 0);
  EXPECT_EQ(many.status, 0);
  EXPECT_LT(two.peakMiB, 160.0);
  EXPECT_LT(many.peakMiB, two.peakMiB + 60.0); // each thread keeps its stack, an arena of malloc, and some rows
}

TEST(StreamLargeVolume, TwoGibibytesTakeAQuarterOfTheirMemory)
{
  const TemporaryFile volume("1024.mha");
  const TemporaryFile surface("1024.stl");
  ASSERT_NO_FATAL_FAILURE(WriteBlobs(volume.GetPath(), 1024));
  for (const unsigned int threads : { 2, 16 })
  {
    const Outcome run = StreamLargeVolume(volume.GetPath(), 96, surface.GetPath(), threads);
    EXPECT_EQ(run.status, 0);
    EXPECT_GT(std::filesystem::file_size(surface.GetPath()), 10u << 20);
    EXPECT_LT(run.peakMiB, 512.0);
    std::cout << threads << " threads: peak memory " << run.peakMiB << " MiB\n";
  }
}

} // namespace
