#pragma once

#include <string>

namespace cardiac {

/// A cell of a table; its content is escaped.
std::string table_cell(const std::string& content, const std::string& classes = "");

/// A number on a card of its own with what it is, its unit and a note under it; all escaped.
std::string number_card(const std::string& name, const std::string& value, const std::string& unit,
                        const std::string& note = "");

}  // namespace cardiac
