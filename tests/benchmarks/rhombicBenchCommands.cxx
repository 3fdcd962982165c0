#include "rhombicBenchCommands.h"

#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"
#include "rhombicScanWriter.h"
#include "rhombicThickMaps.h"
#include "rhombicWording.h"

#include "itkMath.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char ** environ;

namespace rhombic
{
namespace
{

namespace fs = std::filesystem;
using Command = std::vector<std::string>;

/** Starts a command without output, in a process group of its own. */
pid_t
Start(const Command & command)
{
  std::vector<char *> arguments;
  for (const std::string & argument : command)
  {
    arguments.push_back(const_cast<char *>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = -1;
  const int error = posix_spawn(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
  {
    throw Failure(FailureKind::NotFound,
                  command[0] + " can't be started; build it, and call this program from its folder.");
  }
  return process;
}

void
CheckStatus(const Command & command, int status)
{
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    throw Failure(FailureKind::Internal, command[0] + " failed; the times mean nothing.");
  }
}

int
RunCommand(const Command & command)
{
  int status = 0;
  waitpid(Start(command), &status, 0);
  CheckStatus(command, status);
  return status;
}

/** Memory of all processes of a group in MiB.
 * \param kind "Pss:", in which pages that several processes share count once, or "Pss_Anon:", without pages of files */
double
GetGroupMemory(pid_t group, const std::string & kind)
{
  double sum = 0.0;
  std::error_code error;
  for (const auto & entry : fs::directory_iterator("/proc", error))
  {
    const std::string name = entry.path().filename();
    if (!std::all_of(name.begin(), name.end(), [](unsigned char letter) { return std::isdigit(letter); }) ||
        getpgid(std::stoi(name)) != group)
    {
      continue;
    }
    std::ifstream memory(entry.path() / "smaps_rollup");
    for (std::string word; memory >> word;)
    {
      if (double kilobytes = 0.0; word == kind && memory >> kilobytes)
      {
        sum += kilobytes / 1024.0;
      }
    }
  }
  return sum;
}

/** Peak memory of a command with its child processes in MiB, looked at every 10 ms. */
double
MeasurePeakMemory(const Command & command, const std::string & kind = "Pss:")
{
  const pid_t process = Start(command);
  double peak = 0.0;
  int status = 0;
  while (waitpid(process, &status, WNOHANG) == 0)
  {
    peak = std::max(peak, GetGroupMemory(process, kind));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CheckStatus(command, status);
  return peak;
}

/** Compares two commands, ours with its number of threads; a folder of their outputs is removed. */
BenchResult
CompareCommands(const char * section,
                const std::string & candidate,
                const Command & ours,
                const Command & bare,
                const BenchSettings & settings)
{
  BenchResult result;
  result.section = section;
  result.candidate = candidate;
  result.reference = "bare script";
  result.threads = settings.threads;
  result.details["MiB"] = std::round(MeasurePeakMemory(ours));
  result.details["bare MiB"] = std::round(MeasurePeakMemory(bare));
  result.times = TimePairs(
    settings.repeats, [&] { return RunCommand(bare); }, [&] { return RunCommand(ours); });
  return result;
}

/** The triangles of the STL files of a folder. */
std::uintmax_t
CountTriangles(const fs::path & folder)
{
  constexpr std::uintmax_t header = 84;
  constexpr std::uintmax_t triangle = 50;
  std::uintmax_t sum = 0;
  for (const auto & entry : fs::directory_iterator(folder))
  {
    sum += entry.path().extension() == ".stl" ? (fs::file_size(entry) - header) / triangle : 0;
  }
  return sum;
}

/** An empty folder for the outputs of this process, and in it one for ours and one for the bare script. */
fs::path
MakeFolder()
{
  const fs::path folder = fs::temp_directory_path() / ("rhombic-bench-" + std::to_string(getpid()));
  fs::create_directories(folder / "ours");
  fs::create_directories(folder / "bare");
  return folder;
}

/** Three tissues, each inside the one before and the inner two with folds, as those of a brain: 207 x 256 x 215 voxels
 * of 1 mm. */
itk::Image<std::uint16_t, 3>::Pointer
MakeTissues()
{
  constexpr int shells = 3;
  constexpr double wavelength = 22.0;                        // mm
  const auto depthBelow = [](int shell, const Vector3 & p) { // of the surface of the outermost, the second, the third
    const double number = 2.0 * itk::Math::pi / wavelength;
    const double folds = std::sin(number * p[0]) * std::cos(number * p[1]) +
                         std::sin(number * p[1]) * std::cos(number * p[2]) +
                         std::sin(number * p[2]) * std::cos(number * p[0]);
    const double depth = 88.0 * (1.0 - std::hypot(p[0] / 88.0, p[1] / 112.0, p[2] / 92.0));
    return depth - 9.0 * shell + 2.5 * shell * folds;
  };
  std::vector<ThickStructure> tissues;
  for (int shell = 0; shell < shells; ++shell)
  {
    const auto depth = [=](const Vector3 & p) {
      const double outer = depthBelow(shell, p);
      return shell + 1 < shells ? std::min(outer, -depthBelow(shell + 1, p)) : outer;
    };
    tissues.push_back({ "tissue", depth, { { { -104.0, -128.0, -108.0 }, { 104.0, 128.0, 108.0 } } }, false, false });
  }
  return MakeThickMap(tissues, { { 1.0, 1.0, 1.0 }, { 207, 256, 215 } });
}

/** The first words of a command, and more of them. */
Command
Join(Command start, const Command & more)
{
  start.insert(start.end(), more.begin(), more.end());
  return start;
}

/** The report beside an interactive page: what it weighs, and how far it was simplified. */
nlohmann::json
ReadWeight(const fs::path & page)
{
  return nlohmann::json::parse(std::ifstream(page.string() + ".json")).at("page");
}

/** Writes balls as a raw volume of uint16 with a header, slice by slice: voxels of 5 micrometres, values falling by 200
 * a voxel outwards, 20000 at the surface. Returns the balls' volume in mm^3. */
double
WriteBalls(const ScaleVolume & balls, const fs::path & header)
{
  constexpr double spacing = 0.005; // mm
  fs::path voxels = header;
  voxels.replace_extension(".raw");
  const std::string count = std::to_string(balls.size);
  std::ofstream(header) << "ObjectType = Image\nNDims = 3\nDimSize = " << count << ' ' << count << ' ' << count
                        << "\nElementSpacing = 0.005 0.005 0.005\nElementType = MET_USHORT\nBinaryData = True\n"
                           "BinaryDataByteOrderMSB = False\nElementDataFile = "
                        << voxels.filename().string() << '\n';
  std::ofstream file(voxels, std::ios::binary);
  // From the middle of the nearest ball, in voxels.
  const auto fromMiddle = [&balls](unsigned int index) { return index % balls.pitch - 0.5 * balls.pitch + 0.3; };
  std::vector<std::uint16_t> rows(static_cast<std::size_t>(balls.size) * balls.pitch); // those after them are the same
  for (unsigned int z = 0; z < balls.size; ++z)
  {
    for (unsigned int y = 0; y < balls.pitch; ++y)
    {
      const double beside = std::hypot(fromMiddle(y), fromMiddle(z));
      std::uint16_t * const row = rows.data() + static_cast<std::size_t>(y) * balls.size;
      for (unsigned int x = 0; x < balls.pitch; ++x)
      {
        const double depth = balls.radius - std::hypot(beside, fromMiddle(x));
        row[x] = static_cast<std::uint16_t>(std::max(0L, std::lround(20000.0 + 200.0 * depth)));
      }
      for (unsigned int x = balls.pitch; x < balls.size; ++x)
      {
        row[x] = row[x - balls.pitch];
      }
    }
    for (unsigned int y = 0; y < balls.size; y += balls.pitch)
    {
      file.write(reinterpret_cast<const char *>(rows.data()), static_cast<std::streamsize>(2 * rows.size()));
    }
  }
  file.close();
  if (!file)
  {
    throw Failure(FailureKind::Output, voxels.string() + " can't be written; is the disk full?");
  }
  return std::pow(balls.size / balls.pitch, 3) * 4.0 / 3.0 * itk::Math::pi * std::pow(balls.radius * spacing, 3);
}

/** Reads a file once: the least that work on it takes. Returns true. */
bool
ReadOnce(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(std::size_t(1) << 22);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())))
  {}
  return true;
}

bool
HaveSameBytes(const fs::path & first, const fs::path & second)
{
  std::ifstream a(first, std::ios::binary), b(second, std::ios::binary);
  return std::equal(std::istreambuf_iterator<char>(a), {}, std::istreambuf_iterator<char>(b), {});
}

fs::path
FolderOfPrograms()
{
  return fs::read_symlink("/proc/self/exe").parent_path();
}

} // namespace

std::vector<BenchResult>
MeasureCommands(const std::string & scan, double isovalue, const BenchSettings & settings)
{
  if (!fs::is_directory(scan))
  {
    return {};
  }
  const fs::path programs = FolderOfPrograms();
  const fs::path folder = MakeFolder();
  const std::string threads = std::to_string(settings.threads);
  const std::string value = FormatExact(isovalue);
  const Command ours{ programs / "rhombic", "-q", "--threads", threads, "mesh", scan, "-t", value, "-o",
                      folder / "ours/a.stl" };
  const Command bare{ programs / "rhombic-bare-script", scan, value, folder / "bare/a.stl" };
  BenchResult result = CompareCommands("commands", "rhombic mesh", ours, bare, settings);
  result.details["triangles"] = CountTriangles(folder / "ours");
  result.details["bare triangles"] = CountTriangles(folder / "bare");
  result.target = settings.threads > 1 ? std::optional<double>(1.15) : std::nullopt;
  fs::remove_all(folder);
  return { result };
}

std::vector<BenchResult>
MeasureLabelCommands(const std::string & map, const BenchSettings & settings)
{
  const fs::path programs = FolderOfPrograms();
  const fs::path folder = MakeFolder();
  const Command start{ programs / "rhombic", "-q", "--threads", std::to_string(settings.threads) };
  std::vector<BenchResult> results;
  const auto compare = [&](const std::string & name, const fs::path & file, const Command & rest) {
    const Command ours = Join(start, rest);
    const Command bare{ programs / "rhombic-bare-label-script", file, folder / "bare" };
    results.push_back(CompareCommands("labels", name, ours, bare, settings));
  };
  const auto meshAndSlice = [&](const std::string & name, const fs::path & file) {
    compare("mesh " + name, file, { "mesh", file, "-o", folder / "ours/{name}.stl" });
    results.back().details["triangles"] = CountTriangles(folder / "ours");
    results.back().details["bare triangles"] = CountTriangles(folder / "bare");
    compare("slice of " + name, file, { "render", file, "--slice", "axial", "-o", folder / "ours/slice.png" });
  };
  if (!map.empty())
  {
    meshAndSlice("map", map);
  }
  else
  {
    WriteScan(MakeThickMap(MakeThickStructures()), folder / "organs.nrrd");
    WriteScan(MakeTissues(), folder / "tissues.nrrd");
    meshAndSlice("organs", folder / "organs.nrrd");
    const fs::path tissues = folder / "tissues.nrrd";
    compare("page of tissues", tissues, { "render", tissues, "--sheet", "-o", folder / "ours/page.png" });
  }
  fs::remove_all(folder);
  return results;
}

std::vector<BenchResult>
MeasurePage(const std::string & scan, const std::vector<std::string> & source, const BenchSettings & settings)
{
  if (scan.empty())
  {
    throw Failure(FailureKind::Usage, "Pages are of a scan; name one with --scan.");
  }
  constexpr double allowance = 1.5; // seconds
  constexpr double share = 0.25;    // of the triangles, which a page keeps if it has room for them
  constexpr double bytesOfMiB = 1024.0 * 1024.0;
  const fs::path folder = MakeFolder();
  const Command start{ FolderOfPrograms() / "rhombic", "-q", "--threads", std::to_string(settings.threads) };
  const auto draw = [&](const Command & rest) { return Join(start, Join(Join({ "render", scan }, source), rest)); };
  const fs::path file = folder / "ours/page.html";
  const Command page = draw({ "-o", file });
  BenchResult result;
  result.section = "pages";
  result.candidate = "page.html";
  result.reference = "mesh, views, turntable, 1.5 s";
  result.threads = settings.threads;
  result.target = 1.0;
  result.details["MiB"] = std::round(MeasurePeakMemory(page));
  result.details["sheet MiB"] = std::round(MeasurePeakMemory(draw({ "--sheet", "-o", folder / "bare/sheet.pdf" })));
  result.details["page MiB"] = std::round(10.0 * static_cast<double>(fs::file_size(file)) / bytesOfMiB) / 10.0;

  const nlohmann::json weight = ReadWeight(file);
  const double kept = weight.at("triangles").get<double>() / weight.at("trianglesBefore").get<double>();
  const Command simplify{ "--max-error",
                          FormatExact(weight.at("measuredSurfaceError_mm")),
                          "--max-triangles",
                          FormatFixed(100.0 * std::min(share, kept), 3) + "%",
                          "-o",
                          folder / "bare/mesh.glb" };
  const std::pair<std::string, Command> parts[] = {
    { "mesh s", Join(start, Join(Join({ "mesh", scan }, source), simplify)) },
    { "views s",
      draw({ "--view",
             "anterior",
             "--view",
             "posterior",
             "--view",
             "left",
             "--view",
             "right",
             "--size",
             "640x640",
             "--same-scale",
             "-o",
             folder / "bare/view.jpg" }) },
    { "turntable s", draw({ "--turntable", "24", "--size", "440x440", "-o", folder / "bare/turn.jpg" }) }
  };
  std::map<std::string, std::vector<double>> timesOfParts;
  for (unsigned int n = 0; n < settings.repeats; ++n)
  {
    result.times.candidate.push_back(TimeOf([&] { return RunCommand(page); }));
    double sum = allowance;
    for (const auto & [name, command] : parts)
    {
      timesOfParts[name].push_back(TimeOf([&command = command] { return RunCommand(command); }));
      sum += timesOfParts[name].back();
    }
    result.times.reference.push_back(sum);
  }
  for (const auto & [name, times] : timesOfParts)
  {
    result.details[name] = std::round(100.0 * Median(times)) / 100.0;
  }
  fs::remove_all(folder);
  return { result };
}

std::vector<BenchResult>
MeasureScale(const ScaleVolume & balls, const std::string & limit, const BenchSettings & settings)
{
  if (balls.pitch == 0 || balls.size % balls.pitch != 0 || !(balls.radius > 0.0) || balls.radius > 0.45 * balls.pitch)
  {
    throw Failure(
      FailureKind::Usage,
      "Balls lie --scale-pitch voxels apart, of which --scale-size is a multiple, and their radius is above "
      "0 and at most 0.45 of it; write --scale-size 512 --scale-pitch 128 --scale-radius 40, for example.");
  }
  const fs::path folder = MakeFolder();
  const fs::path volume = folder / "balls.mhd";
  const double truth = WriteBalls(balls, volume);
  const auto command = [&](const std::string & most, const fs::path & made) {
    return Command{ FolderOfPrograms() / "rhombic",
                    "-q",
                    "--threads",
                    std::to_string(settings.threads),
                    "mesh",
                    volume,
                    "-t",
                    "20000.5",
                    "--max-memory",
                    most,
                    "-o",
                    made / "balls.ply",
                    "--measures",
                    made / "balls.json" };
  };
  const Command ours = command(limit, folder / "ours");
  const Command whole = command("1024G", folder / "bare");
  constexpr double bytesOfVoxel = 3.0; // in memory: of the lattice, the mesh and the pages of the file in use
  const bool fits = bytesOfVoxel * std::pow(balls.size, 3) < static_cast<double>(FreeMemory());
  BenchResult result;
  result.section = "scale";
  result.candidate = "--max-memory " + limit;
  result.reference = fits ? "in memory" : "reading the file";
  result.threads = settings.threads;
  result.target = fits ? std::optional(1.0 / 1.3) : std::nullopt;
  result.details["size"] = balls.size;
  result.details["MiB"] = std::round(MeasurePeakMemory(ours, "Pss_Anon:"));
  if (fits)
  {
    result.details["in memory MiB"] = std::round(MeasurePeakMemory(whole, "Pss_Anon:"));
    if (!HaveSameBytes(folder / "ours/balls.ply", folder / "bare/balls.ply"))
    {
      throw Failure(FailureKind::Internal, "The meshes made in slabs and in memory differ.");
    }
  }
  if (fits)
  {
    const auto measure = [&result](const std::string & name, const Command & other) {
      result.details[name + " MiB"] = std::round(MeasurePeakMemory(other, "Pss_Anon:"));
      result.details[name + " s"] = std::round(10.0 * TimeOf([&] { return RunCommand(other); })) / 10.0;
    };
    measure("vtkFlyingEdges3D",
            { FolderOfPrograms() / "rhombic-bare-script", volume, "20000.5", folder / "bare/balls.stl" });
    if (fs::exists("/usr/lib/python3/dist-packages/skimage")) // Debian's python3-skimage
    {
      const std::string script =
        "import numpy, sys, skimage.measure; n = int(sys.argv[2]); "
        "skimage.measure.marching_cubes(numpy.fromfile(sys.argv[1], '<u2').reshape(n, n, n), 20000.5)";
      measure("scikit-image", { "/usr/bin/python3", "-c", script, folder / "balls.raw", std::to_string(balls.size) });
    }
  }
  const auto measures = nlohmann::json::parse(std::ifstream(folder / "ours/balls.json"));
  const double measured = 1000.0 * measures.at(0).at("measures").at("volume_ml").get<double>();
  result.details["volume error %"] = std::round(1e4 * 100.0 * (measured / truth - 1.0)) / 1e4;
  result.details["mesh MiB"] =
    std::round(static_cast<double>(fs::file_size(folder / "ours/balls.ply")) / (1024.0 * 1024.0));
  for (unsigned int n = 0; n < settings.repeats; ++n)
  {
    const auto reference = [&] { return fits ? RunCommand(whole) : ReadOnce(folder / "balls.raw"); };
    result.times.reference.push_back(TimeOf(reference));
    result.times.candidate.push_back(TimeOf([&] { return RunCommand(ours); }));
  }
  fs::remove_all(folder);
  return { result };
}

} // namespace rhombic
