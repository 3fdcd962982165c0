#include "rhombicDicomTestFile.h"
#include "rhombicDicomDecoding.h"
#include "rhombicInProcessDecoder.h"
#include "rhombicIsolatedDecoder.h"
#include "rhombicScanTest.h"
#include "rhombicSystemCallFilter.h"

#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmSequenceOfFragments.h>

#include <cctype>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::IsolatedDecoder;
using rhombic::VoxelRequest;

// AddressSanitizer ends a crashing process itself, without a signal.
#ifdef __SANITIZE_ADDRESS__
const std::string Crash = "its decoder ended without an answer";
#else
const std::string Crash = "its decoder crashed (SIG";
#endif

constexpr const char * RunLengths = "1.2.840.10008.1.2.5";
constexpr std::uint16_t Size = 8;
constexpr std::size_t Bytes = 2 * Size * Size;

/** A frame of 16-bit pixels that all have one value, as run lengths (PS3.5, annex G). */
std::string
RunLengthFrame(std::uint16_t value)
{
  const auto number = [](std::uint32_t n) {
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &n, 4);
    return bytes;
  };
  const std::string run{ static_cast<char>(-(Size * Size - 1)) };
  const std::string high = run + static_cast<char>(value >> 8);
  const std::string low = run + static_cast<char>(value & 255);
  return number(2) + number(64) + number(66) + std::string(52, '\0') + high + low;
}

DicomTestFile
MakeSlice(std::size_t k)
{
  DicomTestFile file(Size, Size);
  file.SetFragments({ RunLengthFrame(static_cast<std::uint16_t>(300 + k)) });
  file.SetPosition("0\\0\\" + std::to_string(2 * k));
  return file;
}

/** A file with a private sequence that is so deep that GDCM crashes. */
DicomTestFile
MakeDeadlySlice(std::size_t k)
{
  DicomTestFile file = MakeSlice(k);
  file.SetText(0x00090010, "LO", "RHOMBIC TEST");
  file.SetNestedSequences(0x00091001, 20000);
  return file;
}

class IsolatedDecoding : public ScanTest
{
protected:
  fs::path
  Write(const DicomTestFile & file, const std::string & name) const
  {
    file.Write(m_Folder / name, RunLengths);
    return m_Folder / name;
  }

  /** The message with which decoding fails. */
  static std::string
  FailureOf(rhombic::VoxelDecoder & decoder, const fs::path & path)
  {
    try
    {
      decoder.Decode({ rhombic::DecodeDicomFile, path, Bytes });
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), FailureKind::Unreadable);
      const std::string sentence = failure.GetDescription();
      EXPECT_NE(sentence.find(path.string()), std::string::npos) << sentence;
      return sentence;
    }
    return "none";
  }
};

TEST_F(IsolatedDecoding, GivesTheBytesThatDecodingInProcessGives)
{
  IsolatedDecoder isolated(2);
  rhombic::InProcessDecoder inProcess;
  for (std::size_t k = 0; k < 5; ++k)
  {
    const VoxelRequest request{ rhombic::DecodeDicomFile, this->Write(MakeSlice(k), std::to_string(k)), Bytes };
    const auto one = isolated.Decode(request);
    const auto other = inProcess.Decode(request);
    EXPECT_EQ(std::memcmp(one->GetData(), other->GetData(), Bytes), 0);
    std::uint16_t first = 0;
    std::memcpy(&first, one->GetData(), sizeof(first));
    EXPECT_EQ(first, 300 + k);
  }
}

TEST_F(IsolatedDecoding, SurvivesACrash)
{
  IsolatedDecoder decoder(1);
  const fs::path good = this->Write(MakeSlice(0), "good");
  const fs::path deadly = this->Write(MakeDeadlySlice(1), "deadly");
  for (int n = 0; n < 3; ++n)
  {
    EXPECT_NE(FailureOf(decoder, deadly).find(Crash), std::string::npos) << FailureOf(decoder, deadly);
    EXPECT_EQ(FailureOf(decoder, good), "none");
  }
}

TEST_F(IsolatedDecoding, SurvivesAHang)
{
  const fs::path pipe = m_Folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  IsolatedDecoder::Limits limits;
  limits.seconds = 1;
  limits.patience = 1;
  IsolatedDecoder decoder(1, limits);
  const std::string expected = "took more than 1 seconds";
  EXPECT_NE(FailureOf(decoder, pipe).find(expected), std::string::npos);
  const fs::path good = this->Write(MakeSlice(0), "good");
  std::string failure;
  do // until the machine has that second for it
  {
    failure = FailureOf(decoder, good);
  } while (failure.find(expected) != std::string::npos);
  EXPECT_EQ(failure, "none");
}

TEST_F(IsolatedDecoding, LimitsMemory)
{
  IsolatedDecoder::Limits limits;
  limits.memory = 8 << 20;
  IsolatedDecoder decoder(1, limits);
  DicomTestFile file = MakeSlice(0);
  file.SetText(0x00090010, "LO", "RHOMBIC TEST");
  file.SetLongBytes(0x00091001, std::string(96 << 20, 'x')); // GDCM keeps all of a file; too much for memory that was
                                                             // free already when the worker was forked
  EXPECT_NE(FailureOf(decoder, this->Write(file, "large")), "none");
  EXPECT_EQ(FailureOf(decoder, this->Write(MakeSlice(0), "good")), "none");
}

TEST_F(IsolatedDecoding, ServesManyThreads)
{
  IsolatedDecoder decoder(3);
  const fs::path good = this->Write(MakeSlice(0), "good");
  const fs::path deadly = this->Write(MakeDeadlySlice(1), "deadly");
  std::vector<std::thread> threads;
  for (int n = 0; n < 6; ++n)
  {
    threads.emplace_back([&, n] {
      for (int i = 0; i < 10; ++i)
      {
        const bool isGood = (n + i) % 3 != 0;
        EXPECT_EQ(FailureOf(decoder, isGood ? good : deadly) == "none", isGood);
      }
    });
  }
  for (std::thread & thread : threads)
  {
    thread.join();
  }
}

/** Direct children of this process that are alive or not waited for. */
std::string
Children()
{
  const std::string task = "/proc/self/task/" + std::to_string(getpid());
  std::ifstream file(task + "/children");
  return { std::istreambuf_iterator<char>(file), {} };
}

TEST_F(IsolatedDecoding, LeavesNoProcessBehind)
{
  const std::string before = Children();
  {
    IsolatedDecoder decoder(2);
    FailureOf(decoder, this->Write(MakeSlice(0), "good"));
    EXPECT_NE(Children(), before);
  }
  EXPECT_EQ(Children(), before);
}

TEST_F(IsolatedDecoding, DecodersEndInAnyOrderAndOutliveTheThreadThatMadeThem)
{
  std::unique_ptr<IsolatedDecoder> first;
  std::thread([&first] { first = std::make_unique<IsolatedDecoder>(1); }).join();
  auto second = std::make_unique<IsolatedDecoder>(1);
  const fs::path good = this->Write(MakeSlice(0), "good");
  EXPECT_EQ(FailureOf(*first, good), "none");
  first.reset(); // would wait forever if the other's processes held its socket
  EXPECT_EQ(FailureOf(*second, good), "none");
}

/** The only child of a process. */
pid_t
ChildOf(pid_t parent)
{
  for (const auto & entry : fs::directory_iterator("/proc"))
  {
    if (std::isdigit(entry.path().filename().native()[0]) == 0)
    {
      continue;
    }
    std::ifstream file(entry.path() / "stat");
    const std::string text{ std::istreambuf_iterator<char>(file), {} };
    std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
    std::string state;
    pid_t itsParent = 0;
    if (fields >> state >> itsParent && itsParent == parent && state != "Z")
    {
      return std::stoi(entry.path().filename().string());
    }
  }
  return -1;
}

TEST_F(IsolatedDecoding, AKilledDecoderIsNoDamage)
{
  const fs::path good = this->Write(MakeSlice(0), "good");
  for (const int signal : { SIGKILL, SIGTERM })
  {
    IsolatedDecoder decoder(1);
    EXPECT_EQ(FailureOf(decoder, good), "none");
    const pid_t worker = ChildOf(ChildOf(getpid()));
    ASSERT_GT(worker, 0);
    kill(worker, signal);
    try
    {
      decoder.Decode({ rhombic::DecodeDicomFile, good, Bytes });
      ADD_FAILURE() << "it was decoded";
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), signal == SIGKILL ? FailureKind::Memory : FailureKind::Internal);
      EXPECT_NE(std::string(failure.GetDescription()).find("killed from outside"), std::string::npos)
        << failure.GetDescription();
    }
    EXPECT_EQ(FailureOf(decoder, good), "none") << "by another worker";
  }
}

TEST_F(IsolatedDecoding, WorkersReadButChangeNothing)
{
  const fs::path file = m_Folder / "file";
  std::ofstream(file) << "text";
  const pid_t worker = fork();
  if (worker == 0)
  {
    rhombic::ForbidAllButDecoding();
    const bool reads = open(file.c_str(), O_RDONLY) >= 0;
    const bool writes = open(file.c_str(), O_WRONLY) >= 0 || open((m_Folder / "new").c_str(), O_CREAT, 0600) >= 0 ||
                        unlink(file.c_str()) == 0 || kill(getppid(), 0) == 0 || mkdir((file / "x").c_str(), 0700) == 0;
    _exit((reads ? 0 : 1) + (writes ? 2 : 0));
  }
  int status = 0;
  waitpid(worker, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(IsolatedDecoding, EndsWithAProgramThatIsKilled)
{
  const fs::path good = this->Write(MakeSlice(0), "good");
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t program = fork();
  if (program == 0)
  {
    close(ends[0]);
    IsolatedDecoder decoder(1);
    FailureOf(decoder, good);
    raise(SIGKILL);
  }
  close(ends[1]);
  waitpid(program, nullptr, 0);
  char nothing = 0;
  EXPECT_EQ(read(ends[0], &nothing, 1), 0) << "whoever still had the pipe open would hold this up";
  close(ends[0]);
}

TEST_F(IsolatedDecoding, FolderNamesTheFileThatCrashes)
{
  for (std::size_t k = 0; k < 5; ++k)
  {
    this->Write(k == 2 ? MakeDeadlySlice(k) : MakeSlice(k), "slice" + std::to_string(k));
  }
  IsolatedDecoder decoder(2);
  rhombic::ScanReadOptions options;
  options.decoder = &decoder;
  EXPECT_EQ(KindOfReading(m_Folder, "slice2: " + Crash, options), FailureKind::Unreadable);
  options.onGap = rhombic::ScanReadOptions::Policy::Accept;
  options.onUneven = rhombic::ScanReadOptions::Policy::Accept;
  const auto scan = rhombic::ReadScan(m_Folder, options);
  EXPECT_EQ(scan.sliceOrigins.size(), 4u);
  EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 0, 0, 2 } }), 303 - 1024);
  EXPECT_NE(scan.fileNotes.at(0).find("slice2"), std::string::npos) << scan.fileNotes[0];
}

// Only the header says so, long after the stream was made.
TEST_F(IsolatedDecoding, RefusesValuesOfMoreBitsThanAnnounced)
{
  for (const bool isSigned : { false, true })
  {
    std::vector<std::uint16_t> pixels(std::size_t{ Size } * Size, isSigned ? 0xf800 : 4095);
    DicomTestFile file(Size, Size);
    file.SetShort(0x00280103, isSigned ? 1 : 0);
    const auto recompress = [&](std::uint16_t value) {
      pixels[9] = value;
      file.SetPixels(pixels);
      file.Write(m_Folder / "raw");
      gdcm::ImageReader reader;
      reader.SetFileName((m_Folder / "raw").c_str());
      EXPECT_TRUE(reader.Read());
      gdcm::ImageChangeTransferSyntax change;
      change.SetTransferSyntax(gdcm::TransferSyntax::JPEG2000Lossless);
      change.SetInput(reader.GetImage());
      EXPECT_TRUE(change.Change());
      const auto & stream = change.GetOutput().GetDataElement().GetSequenceOfFragments()->GetFragment(0);
      const gdcm::ByteValue & bytes = *stream.GetByteValue();
      DicomTestFile compressed = file;
      compressed.SetShort(0x00280101, 12);
      compressed.SetShort(0x00280102, 11);
      compressed.SetFragments({ std::string(bytes.GetPointer(), bytes.GetLength()) });
      compressed.Write(m_Folder / "compressed", "1.2.840.10008.1.2.4.90");
      IsolatedDecoder decoder(1);
      return FailureOf(decoder, m_Folder / "compressed");
    };
    EXPECT_EQ(recompress(17), "none");
    const std::string sentence = recompress(isSigned ? 0x0801 : 4097);
    EXPECT_NE(sentence.find("more than the 12 bits"), std::string::npos) << sentence << " for " << isSigned;
  }
}

TEST_F(IsolatedDecoding, RefusesDamagedRunLengths)
{
  IsolatedDecoder decoder(1);
  const auto sentenceOf = [&](std::string frame) {
    DicomTestFile file = MakeSlice(0);
    file.SetFragments({ std::move(frame) });
    return FailureOf(decoder, this->Write(file, "damaged"));
  };
  std::string tooShort = RunLengthFrame(300);
  tooShort[64] = static_cast<char>(-(Size * Size - 2));
  std::string tooLong = RunLengthFrame(300);
  tooLong[66] = static_cast<char>(-(Size * Size));
  std::string noTable = RunLengthFrame(300);
  noTable[0] = 15;
  std::string behindEnd = RunLengthFrame(300);
  behindEnd[8] = 127;
  for (const std::string & frame : { tooShort, tooLong, noTable, behindEnd, std::string("short") })
  {
    EXPECT_NE(sentenceOf(frame).find("run lengths"), std::string::npos) << sentenceOf(frame);
  }
}

} // namespace
