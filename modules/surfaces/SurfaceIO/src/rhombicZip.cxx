#include "rhombicZip.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <limits>

#include <zlib.h>

namespace rhombic
{
namespace
{

constexpr std::uint32_t PartMagic = 0x04034b50; // "PK", and the kind of record
constexpr std::uint32_t SizesMagic = 0x08074b50;
constexpr std::uint32_t EntryMagic = 0x02014b50;
constexpr std::uint32_t EndMagic = 0x06054b50;
constexpr std::uint16_t Version = 20;          // that deflated parts need
constexpr std::uint16_t SizesFollow = 1u << 3; // flags
constexpr std::uint16_t NamesAreUTF8 = 1u << 11;
constexpr std::uint16_t IsEncrypted = 1u << 0;
constexpr std::uint16_t Stored = 0; // methods
constexpr std::uint16_t Deflated = 8;
constexpr std::uint32_t FirstDay = 0x00210000; // 1980-01-01, the earliest
constexpr std::size_t PartHeaderSize = 30;
constexpr std::size_t EntrySize = 46;
constexpr std::size_t EndSize = 22;
constexpr std::size_t ZipBlockSize = std::size_t{ 1 } << 16;
constexpr std::uint32_t Beyond = std::numeric_limits<std::uint32_t>::max(); // stands for a number of 64 bits

template <typename TNumber>
void
Put(std::string & record, TNumber number)
{
  record.append(reinterpret_cast<const char *>(&number), sizeof(number));
}

template <typename TNumber>
TNumber
Get(const char * record, std::size_t offset)
{
  TNumber number;
  std::copy_n(record + offset, sizeof(number), reinterpret_cast<char *>(&number));
  return number;
}

/** The numbers that the header of a part, which comes before its sizes are known, and the entry in the list of parts
 * have in common. */
std::string
CommonNumbers(const ZipPart & part, bool areSizesKnown)
{
  std::string record;
  Put(record, Version);
  Put(record, static_cast<std::uint16_t>(SizesFollow | NamesAreUTF8));
  Put(record, Deflated);
  Put(record, FirstDay);
  Put(record, areSizesKnown ? part.checksum : 0);
  Put(record, areSizesKnown ? part.packedSize : 0);
  Put(record, areSizesKnown ? part.size : 0);
  Put(record, static_cast<std::uint16_t>(part.name.size()));
  Put(record, std::uint16_t{ 0 }); // length of extra fields
  return record;
}

std::string
EntryOf(const ZipPart & part)
{
  std::string record;
  Put(record, EntryMagic);
  Put(record, Version);
  record += CommonNumbers(part, true);
  record.append(2 + 2 + 2 + 4, '\0'); // comment, disk, attributes
  Put(record, part.begin);
  return record + part.name;
}

} // namespace

struct ZipWriter::Deflater
{
  static constexpr int Level = 4; // of text of numbers, less than half of the time of level 6 for 6 % more bytes
  z_stream stream{};
  std::vector<char> text;
  std::vector<char> packed = std::vector<char>(ZipBlockSize);

  Deflater()
  {
    if (deflateInit2(&stream, Level, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    {
      throw Failure(FailureKind::Memory, "There is too little memory to compress a file.");
    }
    text.reserve(ZipBlockSize);
  }
  ~Deflater()
  {
    deflateEnd(&stream);
  }
};

ZipWriter::ZipWriter(OutputFile & file)
  : m_File(file)
  , m_Deflater(std::make_unique<Deflater>())
{}

ZipWriter::~ZipWriter() = default;

void
ZipWriter::AppendToFile(std::string_view bytes)
{
  m_Size += bytes.size();
  if (m_Size >= Beyond)
  {
    throw Failure(FailureKind::Output,
                  "Cannot write " + m_File.GetTarget().string() +
                    ": it would be larger than the 4 GiB of a ZIP archive; choose .vtp or a lower density.");
  }
  m_File.Append(bytes);
}

void
ZipWriter::Begin(const std::string & name)
{
  this->End();
  ZipPart part;
  part.name = name;
  part.begin = static_cast<std::uint32_t>(m_Size);
  m_Parts.push_back(part);
  std::string header;
  Put(header, PartMagic);
  this->AppendToFile(header + CommonNumbers(part, false) + name);
  deflateReset(&m_Deflater->stream);
}

void
ZipWriter::Append(std::string_view bytes)
{
  std::vector<char> & text = m_Deflater->text;
  text.insert(text.end(), bytes.begin(), bytes.end());
  if (text.size() >= ZipBlockSize)
  {
    this->Deflate(Z_NO_FLUSH);
  }
}

void
ZipWriter::Deflate(int flush)
{
  auto & [stream, text, packed] = *m_Deflater;
  ZipPart & part = m_Parts.back();
  if (text.size() >= Beyond - part.size)
  {
    throw Failure(FailureKind::Output,
                  "Cannot write " + m_File.GetTarget().string() +
                    ": its text is longer than the 4 GiB of a part of a ZIP archive; choose .vtp or a lower density.");
  }
  part.checksum =
    static_cast<std::uint32_t>(crc32_z(part.checksum, reinterpret_cast<const Bytef *>(text.data()), text.size()));
  part.size += static_cast<std::uint32_t>(text.size());
  stream.next_in = reinterpret_cast<Bytef *>(text.data());
  stream.avail_in = static_cast<uInt>(text.size());
  do
  {
    stream.next_out = reinterpret_cast<Bytef *>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, flush);
    const std::size_t count = packed.size() - stream.avail_out;
    this->AppendToFile({ packed.data(), count });
    part.packedSize += static_cast<std::uint32_t>(count);
  } while (stream.avail_out == 0);
  text.clear();
}

void
ZipWriter::End()
{
  if (!m_Parts.empty())
  {
    this->Deflate(Z_FINISH);
    std::string sizes;
    Put(sizes, SizesMagic);
    Put(sizes, m_Parts.back().checksum);
    Put(sizes, m_Parts.back().packedSize);
    Put(sizes, m_Parts.back().size);
    this->AppendToFile(sizes);
  }
}

void
ZipWriter::Close()
{
  this->End();
  const auto begin = static_cast<std::uint32_t>(m_Size);
  for (const ZipPart & part : m_Parts)
  {
    this->AppendToFile(EntryOf(part));
  }
  std::string end;
  Put(end, EndMagic);
  Put(end, std::uint32_t{ 0 }); // this disk, and that of the list
  Put(end, static_cast<std::uint16_t>(m_Parts.size()));
  Put(end, static_cast<std::uint16_t>(m_Parts.size()));
  Put(end, static_cast<std::uint32_t>(m_Size - begin));
  Put(end, begin);
  Put(end, std::uint16_t{ 0 }); // length of a comment
  this->AppendToFile(end);
}

ZipReader::ZipReader(const InputFile & file)
  : m_File(file)
{
  constexpr std::size_t longestComment = std::numeric_limits<std::uint16_t>::max();
  const auto tailSize = static_cast<std::size_t>(std::min<std::uintmax_t>(file.GetSize(), EndSize + longestComment));
  std::string tail(tailSize, '\0');
  file.Read(file.GetSize() - tailSize, tail.data(), tailSize);
  std::string magic;
  Put(magic, EndMagic);
  const std::size_t place = tailSize < EndSize ? tail.npos : tail.rfind(magic, tailSize - EndSize);
  if (place == tail.npos)
  {
    file.Refuse("it does not end like a ZIP archive; it may be a part of a file, so copy or export it again");
  }
  const char * const end = tail.data() + place;
  const auto listSize = Get<std::uint32_t>(end, 12);
  const auto listBegin = Get<std::uint32_t>(end, 16);
  constexpr std::uint32_t longestList = 1u << 24;
  if (listSize == Beyond || listBegin == Beyond || listSize > longestList)
  {
    file.Refuse("it is a ZIP archive of more than 4 GiB or of very many parts; export fewer surfaces");
  }
  std::string list(listSize, '\0');
  file.Read(listBegin, list.data(), list.size());
  for (std::size_t offset = 0; offset < list.size();)
  {
    const char * const entry = list.data() + offset;
    const std::size_t rest = list.size() - offset;
    const std::size_t nameSize = rest < EntrySize ? 0 : Get<std::uint16_t>(entry, 28);
    if (rest < EntrySize || rest - EntrySize < nameSize || Get<std::uint32_t>(entry, 0) != EntryMagic)
    {
      file.RefuseDamaged("its list of parts does not follow ZIP");
    }
    if ((Get<std::uint16_t>(entry, 8) & IsEncrypted) != 0)
    {
      file.Refuse("it is encrypted; export it without a password");
    }
    m_Parts.push_back({ std::string(entry + EntrySize, nameSize),
                        Get<std::uint16_t>(entry, 10),
                        Get<std::uint32_t>(entry, 16),
                        Get<std::uint32_t>(entry, 20),
                        Get<std::uint32_t>(entry, 24),
                        Get<std::uint32_t>(entry, 42) });
    offset += EntrySize + nameSize + Get<std::uint16_t>(entry, 30) + Get<std::uint16_t>(entry, 32);
  }
}

const ZipPart *
ZipReader::Find(std::string_view name) const
{
  const std::string wanted = LowerCase(name);
  const auto found =
    std::find_if(m_Parts.begin(), m_Parts.end(), [&](const ZipPart & part) { return LowerCase(part.name) == wanted; });
  return found == m_Parts.end() ? nullptr : &*found;
}

void
ZipReader::Inflate(const ZipPart & part,
                   InputStream & packed,
                   const std::function<void(std::string_view bytes)> & use) const
{
  z_stream stream{};
  if (part.method == Deflated && inflateInit2(&stream, -MAX_WBITS) != Z_OK)
  {
    throw Failure(FailureKind::Memory, "There is too little memory to read " + m_File.GetPath().string() + ".");
  }
  const std::unique_ptr<z_stream, void (*)(z_stream *)> ending(&stream, [](z_stream * s) { inflateEnd(s); });
  std::vector<char> in(ZipBlockSize);
  std::vector<char> out(ZipBlockSize);
  int status = Z_OK;
  for (std::size_t rest = part.packedSize; rest > 0 && status == Z_OK;)
  {
    const std::size_t count = std::min(rest, in.size());
    packed.Take(in.data(), count);
    rest -= count;
    if (part.method == Stored)
    {
      use({ in.data(), count });
      continue;
    }
    stream.next_in = reinterpret_cast<Bytef *>(in.data());
    stream.avail_in = static_cast<uInt>(count);
    do
    {
      stream.next_out = reinterpret_cast<Bytef *>(out.data());
      stream.avail_out = static_cast<uInt>(out.size());
      status = inflate(&stream, Z_NO_FLUSH);
      use({ out.data(), out.size() - stream.avail_out });
    } while (status == Z_OK && stream.avail_out == 0);
    status = status == Z_BUF_ERROR ? Z_OK : status; // all of the block is used
  }
  if (part.method == Deflated && status != Z_STREAM_END)
  {
    m_File.RefuseDamaged("its part " + part.name + " cannot be unpacked");
  }
}

void
ZipReader::Unpack(const ZipPart & part, const std::function<void(std::string_view bytes)> & use) const
{
  if (part.method != Stored && part.method != Deflated)
  {
    m_File.Refuse("it is packed by a rare method; export it with the usual one of ZIP");
  }
  if (part.size == Beyond || part.packedSize == Beyond || part.begin == Beyond)
  {
    m_File.Refuse("it has a part of more than 4 GiB; export fewer surfaces");
  }
  char header[PartHeaderSize];
  m_File.Read(part.begin, header, sizeof(header));
  if (Get<std::uint32_t>(header, 0) != PartMagic)
  {
    m_File.RefuseDamaged("its part " + part.name + " is not where its list of parts says");
  }
  const std::uintmax_t names = std::uintmax_t{ Get<std::uint16_t>(header, 26) } + Get<std::uint16_t>(header, 28);
  const std::uintmax_t begin = part.begin + sizeof(header) + names;
  InputStream packed(m_File, begin);
  if (packed.GetRest() < part.packedSize)
  {
    m_File.RefuseDamaged("its part " + part.name + " is longer than the file");
  }
  constexpr std::uint64_t largestRatio = 100; // text of numbers becomes ten times smaller at most
  constexpr std::uint64_t small = std::uint64_t{ 1 } << 24;
  const std::uint64_t largest = std::max(small, largestRatio * part.packedSize);
  std::uint64_t size = 0;
  std::uint32_t checksum = 0;
  this->Inflate(part, packed, [&](std::string_view bytes) {
    size += bytes.size();
    if (size > part.size || size > largest)
    {
      m_File.RefuseDamaged("its part " + part.name + " unpacks to far more than its size");
    }
    checksum =
      static_cast<std::uint32_t>(crc32_z(checksum, reinterpret_cast<const Bytef *>(bytes.data()), bytes.size()));
    use(bytes);
  });
  if (size != part.size || checksum != part.checksum)
  {
    m_File.RefuseDamaged("its part " + part.name + " has another checksum than its list of parts says");
  }
}

} // namespace rhombic
