#pragma once

#include <cstddef>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "aplomb/io/detail/read_context.h"

namespace aplomb::detail {

/// Parses XML that may cost memory, and may have no DTD (3MF core specification). \pre `xml` outlives the document.
Result<void> parse_xml(const ReadContext& context, std::string_view name, std::string& xml,
                       pugi::xml_document& document);

/// What the tree may take at most: two nodes for a '<', an attribute for a '=', and the text once more in UTF-8.
std::size_t tree_bytes_of(const std::string& xml);

/// An element's or attribute's name without its prefix.
std::string_view local_name(std::string_view name);

/// An attribute's value by its local name; empty when it is missing.
std::string_view attribute(const pugi::xml_node& node, std::string_view local);

}  // namespace aplomb::detail
