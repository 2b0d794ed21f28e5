#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include <polyaffine/mesh_io/file_scanner.hpp>
#include <polyaffine/mesh_io/surface_formats.hpp>

namespace polyaffine {
namespace {

enum class Encoding { text, little, big };

struct Property {
  std::string name, type, count_type;  ///< count_type empty: no list
};

struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties{};
};

std::string_view size_of(std::string_view type) {
  static const std::map<std::string_view, std::string_view> canonical{
      {"char", "i1"},  {"int8", "i1"},    {"uchar", "u1"},  {"uint8", "u1"},
      {"short", "i2"}, {"int16", "i2"},   {"ushort", "u2"}, {"uint16", "u2"},
      {"int", "i4"},   {"int32", "i4"},   {"uint", "u4"},   {"uint32", "u4"},
      {"float", "f4"}, {"float32", "f4"}, {"double", "f8"}, {"float64", "f8"}};
  const auto found = canonical.find(type);
  return found == canonical.end() ? "" : found->second;
}

template <class T>
double value(std::string_view bytes, Encoding encoding) {
  std::array<char, sizeof(T)> in_order;
  std::copy(bytes.begin(), bytes.end(), in_order.begin());
  if ((encoding == Encoding::big) == (std::endian::native == std::endian::little))
    std::ranges::reverse(in_order);
  return static_cast<double>(std::bit_cast<T>(in_order));
}

double read_value(FileScanner& scan, std::string_view type, Encoding encoding) {
  if (encoding == Encoding::text) return scan.real("a number");
  const std::string_view kind = size_of(type);
  const std::string_view bytes = scan.bytes(kind[1] - '0', "a number");
  if (kind == "f8") return value<double>(bytes, encoding);
  if (kind == "f4") return value<float>(bytes, encoding);
  if (kind == "u4") return value<std::uint32_t>(bytes, encoding);
  if (kind == "i4") return value<std::int32_t>(bytes, encoding);
  if (kind == "u2") return value<std::uint16_t>(bytes, encoding);
  if (kind == "i2") return value<std::int16_t>(bytes, encoding);
  if (kind == "u1") return value<std::uint8_t>(bytes, encoding);
  return value<std::int8_t>(bytes, encoding);
}

/// A count or an index, which text may give in any form.
long long read_whole(FileScanner& scan, std::string_view type, Encoding encoding) {
  const double found = read_value(scan, type, encoding);
  if (!(std::abs(found) < 4e18) || found != std::round(found))
    scan.fail("found " + std::to_string(found) + ", expected a whole number");
  return static_cast<long long>(found);
}

Encoding read_header(FileScanner& scan, std::vector<Element>& elements) {
  if (scan.word("ply") != "ply") scan.fail("found no PLY header, expected a file that begins with ply");
  Encoding encoding = Encoding::text;
  while (true) {
    const std::string_view what = scan.word("end_header");
    if (what == "end_header") break;
    if (what == "format") {
      const std::string_view format = scan.word("the format");
      if (format == "binary_little_endian")
        encoding = Encoding::little;
      else if (format == "binary_big_endian")
        encoding = Encoding::big;
      else if (format != "ascii")
        scan.fail("found the format \"" + std::string(format.substr(0, 30)) +
                  "\", expected ascii or binary_…");
    } else if (what == "element") {
      const std::string name(scan.word("the name of an element"));
      elements.push_back({name, scan.count("a number of elements", 1)});
    } else if (what == "property" && !elements.empty()) {
      Property property;
      property.type = scan.word("a type");
      if (property.type == "list") {
        property.count_type = scan.word("a type");
        property.type = scan.word("a type");
        if (size_of(property.count_type).empty())
          scan.fail("found the type \"" + property.count_type + "\", expected a PLY type");
      }
      if (size_of(property.type).empty())
        scan.fail("found the type \"" + property.type + "\", expected a PLY type");
      property.name = scan.word("the name of a property");
      elements.back().properties.push_back(property);
    }
    scan.line();
  }
  scan.line();
  return encoding;
}

/// Values of the properties of one element; a list gives `list`.
void read_row(FileScanner& scan, const Element& element, Encoding encoding, std::vector<double>& values,
              std::vector<long long>& list) {
  values.clear();
  list.clear();
  for (const Property& property : element.properties) {
    if (property.count_type.empty()) {
      values.push_back(read_value(scan, property.type, encoding));
      continue;
    }
    const long long n = read_whole(scan, property.count_type, encoding);
    scan.check_count(n, "the length of a list", 1);
    std::vector<long long> entries(static_cast<std::size_t>(n));
    const bool corners = property.name.starts_with("vertex_ind");
    for (long long& entry : entries)
      if (corners)
        entry = read_whole(scan, property.type, encoding);
      else
        read_value(scan, property.type, encoding);
    if (corners) list = std::move(entries);
    values.push_back(0);
  }
}

void read_points(FileScanner& scan, const Element& element, Encoding encoding, MeshData& data) {
  std::array<std::size_t, 3> column{};
  for (int k = 0; k < 3; ++k) {
    const auto at =
        std::ranges::find(element.properties, std::string(1, static_cast<char>('x' + k)), &Property::name);
    if (at == element.properties.end())
      scan.fail("found no property x, y and z of vertices, expected coordinates");
    column[k] = at - element.properties.begin();
  }
  data.points.resize(3, static_cast<Eigen::Index>(element.count));
  std::vector<double> values;
  std::vector<long long> list;
  for (auto x : data.points.colwise()) {
    read_row(scan, element, encoding, values, list);
    for (int k = 0; k < 3; ++k) x[k] = values[column[k]];
  }
}

void read_faces(FileScanner& scan, const Element& element, Encoding encoding, MeshData& data) {
  CellList triangles{3};
  std::vector<std::vector<double>> fields(element.properties.size());
  std::vector<double> values;
  std::vector<long long> list;
  std::vector<int> corners;
  for (std::size_t f = 0; f < element.count; ++f) {
    read_row(scan, element, encoding, values, list);
    if (list.size() < 3)
      scan.fail("found a face of " + std::to_string(list.size()) + " points, expected at least 3");
    corners.clear();
    for (const double p : list)
      corners.push_back(scan.vertex(static_cast<long long>(p), 0, data.points.cols()));
    add_polygon(triangles, corners);
    for (std::size_t p = 0; p < fields.size(); ++p)
      fields[p].insert(fields[p].end(), corners.size() - 2, values[p]);
  }
  data.triangles = triangles.matrix();
  for (std::size_t p = 0; p < fields.size(); ++p)
    if (element.properties[p].count_type.empty())
      data.triangle_fields[element.properties[p].name] =
          Eigen::Map<Eigen::RowVectorXd>(fields[p].data(), triangles.size());
}

}  // namespace

MeshData read_ply(const std::filesystem::path& file) {
  FileScanner scan(file);
  std::vector<Element> elements;
  const Encoding encoding = read_header(scan, elements);
  MeshData data;
  data.source = file;
  std::vector<double> values;
  std::vector<long long> list;
  for (const Element& element : elements) {
    if (element.properties.empty()) continue;
    if (element.name == "vertex")
      read_points(scan, element, encoding, data);
    else if (element.name == "face")
      read_faces(scan, element, encoding, data);
    else
      for (std::size_t i = 0; i < element.count; ++i) read_row(scan, element, encoding, values, list);
  }
  return data;
}

}  // namespace polyaffine
