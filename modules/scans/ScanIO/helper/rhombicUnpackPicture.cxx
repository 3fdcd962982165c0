// rhombic-unpack-picture: reads the values of grey pictures, as slices of a stack, by OpenImageIO.

#include "rhombicSandboxChild.h"
#include "rhombicTIFFPages.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

namespace rhombic
{
namespace
{

[[noreturn]] void
Refuse(const std::string & why)
{
  throw SandboxRefusal("it can't be read as a picture (" + why.substr(0, why.find('\n')) +
                       "); copy it again from its source");
}

/** What a stack has to know of a picture. */
std::string
Describe(const SandboxInput & input, const OIIO::ImageSpec & spec)
{
  const std::string type = spec.format.c_str(); // as "uint16"
  nlohmann::json json{ { "width", spec.width },
                       { "height", spec.height },
                       { "channels", spec.nchannels },
                       { "type", type == "half" ? "float" : type },
                       { "bits", spec.get_int_attribute("oiio:BitsPerSample", 0) } };
  if (input.arguments.rfind("tiff ", 0) == 0)
  {
    const auto pages = CountTIFFPages(input.file, input.size);
    if (!pages)
    {
      throw SandboxRefusal("its list of pages is damaged or cut off; copy it again from its source");
    }
    json["pages"] = pages->ofFirstSize;
    json["others"] = pages->others;
    const PageDescription described = ReadPageDescription(spec.get_string_attribute("ImageDescription"));
    json["announced"] = described.announced;
    json["sizes"] = described.sizes;
    json["voxel"] = described.voxel; // 0 where it is not told
  }
  return json.dump();
}

/** Delivers the values of all rows in their order, in bands of as many as fit into a piece. */
void
DeliverRows(OIIO::ImageInput & input, SandboxOutput & output)
{
  const int page = input.current_subimage();
  const OIIO::ImageSpec spec = input.spec();
  const OIIO::TypeDesc type = spec.format == OIIO::TypeDesc::HALF ? OIIO::TypeDesc(OIIO::TypeDesc::FLOAT) : spec.format;
  const std::size_t rowBytes = static_cast<std::size_t>(spec.width) * type.size();
  const int tile = std::max(1, spec.tile_height);
  const int rows = std::max(1, static_cast<int>(output.GetSize() / rowBytes) / tile) * tile;
  const int end = spec.y + spec.height;
  for (int begin = spec.y; begin < end; begin += rows)
  {
    const int bandEnd = std::min(begin + rows, end);
    std::byte * const values = output.GetBuffer();
    const bool isRead =
      spec.tile_width > 0
        ? input.read_tiles(page, 0, spec.x, spec.x + spec.width, begin, bandEnd, 0, 1, 0, 1, type, values)
        : input.read_scanlines(page, 0, begin, bandEnd, 0, 0, 1, type, values);
    if (!isRead)
    {
      Refuse(input.geterror());
    }
    output.Deliver(static_cast<std::size_t>(bandEnd - begin) * rowBytes);
  }
}

/** The arguments are OpenImageIO's name of the format, and "header" or the number of a page whose pixels are wanted. */
void
UnpackPicture(const SandboxInput & input, SandboxOutput & output)
{
  const auto space = input.arguments.find(' ');
  const std::string wanted = input.arguments.substr(space + 1);
  OIIO::Filesystem::IOMemReader memory(input.file, input.size);
  const auto picture = OIIO::ImageInput::create(input.arguments.substr(0, space));
  OIIO::ImageSpec spec;
  if (!picture || !picture->set_ioproxy(&memory) || !picture->open("picture", spec))
  {
    Refuse(picture ? picture->geterror() : OIIO::geterror());
  }
  if (wanted == "header")
  {
    const std::string text = Describe(input, spec);
    std::copy_n(text.begin(), std::min(text.size(), output.GetSize()), reinterpret_cast<char *>(output.GetBuffer()));
    output.Deliver(std::min(text.size(), output.GetSize()));
    return;
  }
  if (!picture->seek_subimage(std::stoi(wanted), 0))
  {
    Refuse(picture->geterror());
  }
  DeliverRows(*picture, output);
}

} // namespace
} // namespace rhombic

int
main(int argc, char ** argv)
{
  OIIO::attribute("debug", 0);
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  OIIO::ImageInput::create("tiff"); // which looks for plugins, while files can be opened
  return rhombic::RunSandboxChild(argc, argv, rhombic::UnpackPicture);
}
