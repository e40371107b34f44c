// Names of XML elements, whatever prefix a document has given to their name space.
#pragma once

#include <pugixml.hpp>
#include <string_view>

namespace frontend {

/// Returns the element's name without the prefix of a name space.
inline std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);  // all of it if there is no colon
}

/// Calls visit(child) with the element's children of that name.
template <typename Visit>
void for_each_child(const pugi::xml_node& node, std::string_view name, const Visit& visit) {
  for (const pugi::xml_node& child : node.children()) {
    if (local_name(child) == name) visit(child);
  }
}

}  // namespace frontend
