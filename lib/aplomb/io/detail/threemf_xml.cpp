#include "aplomb/io/detail/threemf_xml.h"

#include <algorithm>
#include <cctype>

namespace aplomb::detail {
namespace {

/// 3MF allows UTF-8 and UTF-16, which begins with a mark or has a zero for every '<'; Latin-1 is read where it is
/// declared. Said to pugixml, so that it copies and converts nothing that was not counted.
pugi::xml_encoding encoding_of(std::string_view xml) {
  const std::string_view head = xml.substr(0, 4);
  if (head.starts_with("\xFE\xFF") || head.starts_with("\xFF\xFE") || head.find('\0') != head.npos)
    return pugi::encoding_auto;
  if (!xml.starts_with("<?xml")) return pugi::encoding_utf8;
  std::string declaration(xml.substr(0, std::min<std::size_t>(xml.find('?', 2), 200)));
  for (char& c : declaration) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view name : {"iso-8859-1\"", "iso-8859-1'", "latin1"})
    if (declaration.find(name) != declaration.npos) return pugi::encoding_latin1;
  return pugi::encoding_utf8;
}

}  // namespace

std::size_t tree_bytes_of(const std::string& xml) {
  const auto tags = std::count(xml.begin(), xml.end(), '<'), attributes = std::count(xml.begin(), xml.end(), '=');
  return static_cast<std::size_t>(tags) * 128 + static_cast<std::size_t>(attributes) * 48 +
         (encoding_of(xml) == pugi::encoding_utf8 ? 0 : 2 * xml.size());
}

std::string_view local_name(std::string_view name) { return name.substr(name.find(':') + 1); }

std::string_view attribute(const pugi::xml_node& node, std::string_view local) {
  for (const pugi::xml_attribute& each : node.attributes())
    if (local_name(each.name()) == local) return each.value();
  return {};
}

Result<void> parse_xml(const ReadContext& context, std::string_view name, std::string& xml,
                       pugi::xml_document& document) {
  const std::string place = "part " + in_quotes(name);
  if (auto admitted = context.admit(0, 0, tree_bytes_of(xml)); !admitted) return admitted;
  const auto parsed = document.load_buffer_inplace(
      xml.data(), xml.size(), pugi::parse_escapes | pugi::parse_wconv_attribute | pugi::parse_doctype,
      encoding_of(xml));
  for (const pugi::xml_node& node : document)
    if (node.type() == pugi::node_doctype)
      return context.unusable(place, "it has a document type definition, which 3MF forbids; export the model again");
  if (!parsed)
    return context.unusable(
        place + ", byte " + std::to_string(parsed.offset),
        std::string("it is no well-formed XML (") + parsed.description() + "); export the model again");
  return {};
}

}  // namespace aplomb::detail
