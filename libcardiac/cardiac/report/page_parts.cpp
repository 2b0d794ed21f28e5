#include <cardiac/report/page_parts.hpp>

#include <cardiac/report/text.hpp>

namespace cardiac {

std::string table_cell(const std::string& content, const std::string& classes) {
  return (classes.empty() ? "<td>" : "<td class=\"" + classes + "\">") + escape_markup(content) + "</td>";
}

std::string number_card(const std::string& name, const std::string& value, const std::string& unit,
                        const std::string& note) {
  std::string html = "<div class=\"card\"><div class=\"name\">" + escape_markup(name) +
                     "</div><div class=\"value\">" + escape_markup(value) + " <span class=\"unit\">" +
                     escape_markup(unit) + "</span></div>";
  if (!note.empty()) html += "<div class=\"note\">" + escape_markup(note) + "</div>";
  return html + "</div>\n";
}

}  // namespace cardiac
