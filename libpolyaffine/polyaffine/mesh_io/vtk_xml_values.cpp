#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

#include <polyaffine/mesh_io/vtk_xml.hpp>

namespace polyaffine::vtk_xml {
namespace {

// What numbers may take: this and a hundred times the size of the file.
constexpr std::size_t kMemory = std::size_t{256} << 20U;

// Numbers of type T one after the other, in this machine's order of bytes (little-endian).
template <class T>
std::vector<double> numbers(const std::string& bytes) {
  std::vector<double> out(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < out.size(); ++i) {
    T number;
    std::memcpy(&number, bytes.data() + i * sizeof number, sizeof number);
    out[i] = static_cast<double>(number);
  }
  return out;
}

// Turns the bytes of every word of `width` bytes round.
void turn_round(std::string& bytes, std::size_t width) {
  for (std::size_t at = 0; at + width <= bytes.size(); at += width)
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + width));
}

struct Type {
  const char* name;
  std::size_t bytes;
  std::vector<double> (*decode)(const std::string& bytes);
};

constexpr std::array kTypes{
    Type{"Int8", 1, numbers<std::int8_t>},   Type{"UInt8", 1, numbers<std::uint8_t>},
    Type{"Int16", 2, numbers<std::int16_t>}, Type{"UInt16", 2, numbers<std::uint16_t>},
    Type{"Int32", 4, numbers<std::int32_t>}, Type{"UInt32", 4, numbers<std::uint32_t>},
    Type{"Int64", 8, numbers<std::int64_t>}, Type{"UInt64", 8, numbers<std::uint64_t>},
    Type{"Float32", 4, numbers<float>},      Type{"Float64", 8, numbers<double>}};

const Type* type_of(const DataArray& array) {
  const std::string name = array.attribute("type");
  const auto found = std::ranges::find_if(kTypes, [&](const Type& type) { return type.name == name; });
  return found == kTypes.end() ? nullptr : &*found;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// The bytes of an array, raw or base64, taken from the front.
class ByteStream {
 public:
  ByteStream(Document& document, const DataArray& array) : document_(document), array_(array) {
    constexpr std::string_view kSpace = " \t\r\n";
    left_ = array.text;
    if (array.attribute("format") == "appended") {
      base64_ = document.appended_base64;
      const std::string offset = array.attribute("offset");
      std::size_t from = 0;
      const auto [end, error] = std::from_chars(offset.data(), offset.data() + offset.size(), from);
      if (error != std::errc() || end != offset.data() + offset.size() || from > document.appended.size())
        fail("found the offset \"" + offset.substr(0, 30) +
             "\", expected a place in the appended data (is the file cut off?)");
      left_ = document.appended.substr(from);
    } else {
      left_.remove_prefix(std::min(left_.find_first_not_of(kSpace), left_.size()));
    }
  }

  std::size_t left() const { return left_.size(); }

  /// The next bytes, which base64 codes in a row of their own.
  std::string take(std::size_t count) {
    std::string out = peek(count);
    left_.remove_prefix(base64_ ? (count + 2) / 3 * 4 : count);
    return out;
  }

  /// The same, and they stay.
  std::string peek(std::size_t count) const {
    if (count > left_.size() || (base64_ && (count + 2) / 3 * 4 > left_.size()))
      fail("found " + std::to_string(left_.size()) + " characters of data, expected " +
           std::to_string(count) + " bytes (is the file cut off?)");
    if (!base64_) return std::string(left_.substr(0, count));
    std::string out;
    for (std::size_t at = 0; out.size() < count; at += 4) {
      std::uint32_t four = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const char c = left_[at + k];
        const int digit = c == '=' && k >= 2 ? 0 : base64_digit(c);
        if (digit < 0) fail("found data that are not base64");
        four = four << 6U | static_cast<std::uint32_t>(digit);
      }
      for (const unsigned shift : {16U, 8U, 0U})
        if (out.size() < count) out += static_cast<char>(four >> shift & 0xffU);
    }
    return out;
  }

  [[noreturn]] void fail(const std::string& what) const { document_.fail(array_.position, what); }

 private:
  Document& document_;
  const DataArray& array_;
  std::string_view left_;
  bool base64_ = true;
};

/// The head of an array: words of 4 or 8 bytes that tell sizes.
struct Head {
  std::size_t width;
  bool big_endian;

  std::size_t word(const std::string& bytes, std::size_t index) const {
    std::string own = bytes.substr(index * width, width);
    if (big_endian) turn_round(own, width);
    std::uint64_t out = 0;
    std::memcpy(&out, own.data(), width);
    return out;
  }
};

// Blocks of zlib behind a head: their number, the size of each and of the last one (0: as the others), then
// the compressed sizes.
std::string inflated(ByteStream& stream, const Head& head, std::size_t size) {
  const std::size_t blocks = head.word(stream.peek(head.width), 0);
  if (blocks > stream.left()) stream.fail("found damaged data, expected the sizes of their blocks");
  const std::string sizes = stream.take((3 + blocks) * head.width);
  const std::size_t whole = head.word(sizes, 1), last = head.word(sizes, 2);
  std::size_t packed = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t block = head.word(sizes, 3 + b);
    if (block > stream.left() - packed) stream.fail("found damaged data, expected blocks that fit the file");
    packed += block;
  }
  const std::string in = stream.take(packed);
  std::string out(size, '\0');
  std::size_t from = 0, to = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t taken = head.word(sizes, 3 + b);
    const std::size_t expected = b + 1 == blocks && last > 0 ? last : whole;
    uLongf given = size - to;
    if (expected > given ||
        uncompress(reinterpret_cast<Bytef*>(out.data()) + to, &given,
                   reinterpret_cast<const Bytef*>(in.data()) + from, taken) != Z_OK ||
        given != expected)
      stream.fail("found damaged data, expected zlib's");
    from += taken;
    to += given;
  }
  if (to != size) stream.fail("found other numbers of values than announced");
  return out;
}

std::string bytes_of(Document& document, const DataArray& array, std::size_t size) {
  const auto attribute = [&](const char* name) {
    const auto found = document.file.find(name);
    return found == document.file.end() ? "" : found->second;
  };
  const Head head{attribute("header_type") == "UInt64" ? std::size_t{8} : 4, document.big_endian};
  const std::string compressor = attribute("compressor");
  ByteStream stream(document, array);
  if (compressor == "vtkZLibDataCompressor") return inflated(stream, head, size);
  if (!compressor.empty())
    stream.fail("found the compressor " + compressor.substr(0, 40) +
                ", expected vtkZLibDataCompressor or none: write the file again with zlib or uncompressed");
  if (const std::size_t found = head.word(stream.peek(head.width), 0); found != size)
    stream.fail("found " + std::to_string(found) + " bytes, expected " + std::to_string(size));
  return stream.take(head.width + size).substr(head.width);
}

std::vector<double> written_out(Document& document, const DataArray& array, std::size_t count) {
  std::vector<double> out;
  const char* at = array.text.data();
  const char* const end = at + array.text.size();
  const auto position = [&] { return array.position + static_cast<std::size_t>(at - array.text.data()); };
  while (true) {
    while (at != end && (*at == ' ' || (*at >= '\t' && *at <= '\r'))) ++at;
    if (at == end) break;
    double number = 0;
    if (*at == '+') ++at;
    const auto [next, error] = std::from_chars(at, end, number);
    const bool tiny = error == std::errc::result_out_of_range &&
                      std::string_view(at, next).find('-', 1) != std::string_view::npos;
    if (error != std::errc() && !tiny) document.fail(position(), "found no number, expected one");
    out.push_back(number);
    at = next;
  }
  if (out.size() != count)
    document.fail(array.position,
                  "found " + std::to_string(out.size()) + " numbers, expected " + std::to_string(count));
  return out;
}

}  // namespace

bool has_numbers(const DataArray& array) {
  return type_of(array) != nullptr;
}

std::vector<double> values(Document& document, const DataArray& array, std::size_t count) {
  const Type* type = type_of(array);
  if (type == nullptr)
    document.fail(array.position, "found the type \"" + array.attribute("type").substr(0, 30) +
                                      "\", expected numbers as Float64 or Int32");
  if (count * sizeof(double) > kMemory + 100 * document.scan.size())
    document.fail(array.position, "found " + std::to_string(count) +
                                      " numbers announced, expected what fits the size of the file");
  const std::string format = array.attribute("format", "ascii");
  if (format == "ascii") return written_out(document, array, count);
  if (format != "binary" && format != "appended")
    document.fail(array.position,
                  "found the format \"" + format.substr(0, 30) + "\", expected ascii, binary or appended");
  std::string bytes = bytes_of(document, array, count * type->bytes);
  if (document.big_endian) turn_round(bytes, type->bytes);
  return type->decode(bytes);
}

}  // namespace polyaffine::vtk_xml
