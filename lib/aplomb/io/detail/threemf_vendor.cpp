#include "aplomb/io/detail/threemf_vendor.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>

#include "aplomb/io/detail/threemf_xml.h"

namespace aplomb::detail {
namespace {

constexpr std::string_view kPrusa = "Metadata/Slic3r_PE_model.config", kBambu = "Metadata/model_settings.config";

bool read_whole(std::string_view text, std::size_t& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

/// The value of <metadata key="..." value="..."/> under a node.
std::string_view metadata(const pugi::xml_node& node, std::string_view key) {
  for (const pugi::xml_node& each : node.children("metadata"))
    if (key == each.attribute("key").value()) return each.attribute("value").value();
  return {};
}

void read_prusa_volumes(const pugi::xml_node& object, ResourceId id, ReadContext& context, ThreemfVendor& vendor) {
  for (const pugi::xml_node& volume : object.children("volume")) {
    const std::string_view type = metadata(volume, "volume_type");
    const bool is_modifier = type.empty() && metadata(volume, "modifier") == "1";  // before PrusaSlicer 1.42
    if ((type.empty() || type == "ModelPart") && !is_modifier) continue;
    std::size_t first = 0, last = 0;
    if (!read_whole(volume.attribute("firstid").value(), first) ||
        !read_whole(volume.attribute("lastid").value(), last))
      continue;
    vendor.left_out_triangles[id].emplace_back(first, last);
    context.note("a volume of object " + std::to_string(id) + " is marked " +
                 in_quotes(is_modifier ? "modifier" : type) + " and was left out");
  }
}

void read_bambu_parts(const pugi::xml_node& object, ResourceId id, ReadContext& context, ThreemfVendor& vendor) {
  for (const pugi::xml_node& part : object.children("part")) {
    const std::string_view subtype = part.attribute("subtype").value();
    std::size_t part_id = 0;
    if (subtype.empty() || subtype == "normal_part" || !read_whole(part.attribute("id").value(), part_id)) continue;
    vendor.left_out_components[id].insert(static_cast<ResourceId>(part_id));
    context.note("a part of object " + std::to_string(id) + " is marked " + in_quotes(subtype) + " and was left out");
  }
}

Result<void> read_config(std::string_view name, ReadContext& context, ZipReader& zip, ThreemfVendor& vendor) {
  if (!zip.has(name)) return {};
  auto xml = zip.read(name);
  if (!xml) return tl::unexpected<Error>(xml.error());
  pugi::xml_document document;
  if (auto parsed = parse_xml(context, name, *xml, document); !parsed) return parsed;
  for (const pugi::xml_node& object : document.document_element().children("object")) {
    std::size_t id = 0;
    if (!read_whole(object.attribute("id").value(), id) || id > 0x7fffffff) continue;
    const auto object_id = static_cast<ResourceId>(id);
    if (const std::string_view text = metadata(object, "name"); !text.empty())
      vendor.names.emplace(object_id, short_name(text));
    read_prusa_volumes(object, object_id, context, vendor);
    read_bambu_parts(object, object_id, context, vendor);
  }
  return {};
}

/// Settings hold scripts (post-processing, machines' G-code); G-code is a program. None of it is read.
void note_what_slicers_left(ReadContext& context, const ZipReader& zip) {
  const auto ends_as_one_of = [](std::string_view key, std::initializer_list<std::string_view> endings) {
    return std::any_of(endings.begin(), endings.end(),
                       [key](std::string_view ending) { return key.ends_with(ending); });
  };
  bool has_settings = false, has_programs = false;
  for (const auto& [key, index] : zip.entries()) {
    const bool is_of_cura = key.starts_with("cura/");
    has_settings |= is_of_cura ||
                    (key.starts_with("metadata/") && ends_as_one_of(key, {".config", ".xml", ".json", ".ini", ".cfg"}));
    has_programs |= ends_as_one_of(key, {".gcode", ".gco", ".bgcode"});
  }
  if (has_settings)
    context.note("a slicer's settings in the file (and any scripts in them) were ignored and are not written");
  if (has_programs) context.note("G-code in the file was ignored and is not written");
}

}  // namespace

Result<ThreemfVendor> read_threemf_vendor(ReadContext& context, ZipReader& zip) {
  ThreemfVendor vendor;
  for (const std::string_view name : {kPrusa, kBambu})
    if (auto done = read_config(name, context, zip, vendor); !done) return tl::unexpected<Error>(done.error());
  note_what_slicers_left(context, zip);
  return vendor;
}

}  // namespace aplomb::detail
