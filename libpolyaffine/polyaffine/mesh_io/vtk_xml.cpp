#include "polyaffine/mesh_io/vtk_xml.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace polyaffine::vtk_xml {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

bool is_blank(std::string_view text) {
  return text.find_first_not_of(kSpace) == std::string_view::npos;
}

std::string unescaped(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
      {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};
  std::string out;
  while (!text.empty()) {
    std::size_t length = 1;
    char meant = text.front();
    for (const auto& [entity, character] : kEntities)
      if (text.starts_with(entity)) {
        length = entity.size();
        meant = character;
      }
    out += meant;
    text.remove_prefix(length);
  }
  return out;
}

// The attributes behind the name of a tag.
Attributes attributes(const FileScanner& scan, std::string_view text) {
  Attributes out;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
    if (text.empty()) return out;
    const std::size_t equals = text.find('=');
    const std::size_t open = equals == std::string_view::npos ? equals : equals + 1;
    if (open >= text.size() || (text[open] != '"' && text[open] != '\''))
      scan.fail("found a damaged tag, expected attributes as NAME=\"VALUE\"");
    const std::size_t close = text.find(text[open], open + 1);
    if (close == std::string_view::npos) scan.fail("found a damaged tag, expected a closing quotation mark");
    std::string_view name = text.substr(0, equals);
    name = name.substr(0, name.find_last_not_of(kSpace) + 1);
    out[std::string(name)] = unescaped(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
  }
}

std::string value_of(const Attributes& of, const std::string& name, const std::string& otherwise) {
  const auto found = of.find(name);
  return found == of.end() ? otherwise : found->second;
}

}  // namespace

std::string DataArray::attribute(const std::string& name, const std::string& otherwise) const {
  return value_of(attributes, name, otherwise);
}

Document::Document(const std::filesystem::path& path) : scan(path) {
  std::vector<std::string> open;
  while (!open.empty() || !scan.at_end()) {
    const std::size_t begin = scan.position();
    const std::string_view text = scan.up_to("<");
    if (!open.empty() && open.back() == "DataArray" && is_blank(arrays.back().text)) {
      arrays.back().text = text;
      arrays.back().position = begin;
    }
    std::string_view tag = scan.up_to(">");
    if (tag.starts_with("!--")) {
      if (!tag.ends_with("--")) scan.up_to("-->");
    } else if (tag.starts_with('/')) {
      if (open.empty() || tag.substr(1, tag.find_last_not_of(kSpace)) != open.back())
        fail(begin, "found a damaged file, expected the tag that closes an element");
      open.pop_back();
    } else if (!tag.starts_with('?')) {
      const bool closed = tag.ends_with('/');
      if (closed) tag.remove_suffix(1);
      const std::string name(tag.substr(0, tag.find_first_of(kSpace)));
      const std::string around = open.empty() ? "" : open.back();
      const Attributes found = attributes(scan, tag.substr(name.size()));
      if (around.empty()) check_root(name, found);
      if (name == "Piece") pieces.push_back(found);
      if (name == "DataArray")
        arrays.push_back({around, static_cast<int>(pieces.size()) - 1, found, {}, scan.position()});
      if (name == "AppendedData") {
        appended_base64 = value_of(found, "encoding", "raw") == "base64";
        scan.up_to("_");
        appended = scan.text().substr(scan.position());
        return;
      }
      if (!closed) open.push_back(name);
    }
  }
  if (file.empty()) fail(0, "found no element, expected a VTK XML file");
}

void Document::check_root(const std::string& name, const Attributes& attributes) {
  if (name != "VTKFile" || value_of(attributes, "type", "") != "UnstructuredGrid")
    scan.fail("found another file, expected a VTK XML file of the type UnstructuredGrid");
  big_endian = value_of(attributes, "byte_order", "LittleEndian") == "BigEndian";
  file = attributes;
}

const DataArray& Document::array(int piece, const std::string& section, const std::string& name) const {
  for (const DataArray& candidate : arrays)
    if (candidate.piece == piece && candidate.section == section &&
        (name.empty() || candidate.attribute("Name") == name))
      return candidate;
  throw InputError(scan.file().string() + ": found no array " + name + (name.empty() ? "" : " ") + "in <" +
                   section + "> of piece " + std::to_string(piece + 1) +
                   ", expected a VTK XML file of an unstructured grid");
}

void Document::fail(std::size_t position, const std::string& what) {
  scan.go_to(position);
  scan.fail(what);
}

}  // namespace polyaffine::vtk_xml
