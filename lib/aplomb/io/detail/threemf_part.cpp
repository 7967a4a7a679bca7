#include "aplomb/io/detail/threemf_part.h"

#include <algorithm>
#include <optional>

#include "aplomb/io/detail/text_cursor.h"
#include "aplomb/io/detail/threemf_xml.h"

namespace aplomb::detail {
namespace {

std::optional<double> number_in(std::string_view text) {
  TextCursor cursor(text);
  cursor.skip_to_word();
  const auto value = cursor.number();
  cursor.skip_to_word();
  return cursor.at_end() ? value : std::nullopt;
}

std::optional<std::uint32_t> index_in(std::string_view text) {
  TextCursor cursor(text);
  cursor.skip_to_word();
  const auto value = cursor.integer();
  cursor.skip_to_word();
  constexpr long long kMost = 0x7fffffff;
  return value && cursor.at_end() && *value >= 0 && *value <= kMost ? std::optional(static_cast<std::uint32_t>(*value))
                                                                    : std::nullopt;
}

std::optional<double> unit_named(std::string_view unit) {
  if (unit.empty() || unit == "millimeter") return 1;
  if (unit == "micron") return 0.001;
  if (unit == "centimeter") return 10;
  if (unit == "inch") return 25.4;
  if (unit == "foot") return 304.8;
  if (unit == "meter") return 1000;
  return {};
}

/// Extensions that change how a model looks or is packed, not its shape.
bool keeps_the_shape(std::string_view name_space) {
  for (const std::string_view known : {"/production/", "/material/", "/trianglesets/", "/core/", "bambulab", "slic3r"})
    if (name_space.find(known) != name_space.npos) return true;
  return false;
}

constexpr std::size_t kMostPath = 1000, kMostExtensions = 100;
// Of an object or a reference: its node in a map, and what a vector that doubles keeps free.
constexpr std::size_t kObjectBytes = sizeof(ThreemfObject) + 80, kReferenceBytes = 3 * sizeof(ThreemfReference);

class PartReader {
 public:
  PartReader(ReadContext& context, std::string_view part) : context_(context), part_(part) {}

  Result<ThreemfPart> read(const pugi::xml_node& model) {
    if (local_name(model.name()) != "model") return unusable("its root is not a model");
    const std::string_view name = model.name();
    prefix_ = name.substr(0, name.size() - std::string_view("model").size());
    for (const char* local : {"vertex", "triangle"})
      (local[0] == 'v' ? vertex_name_ : triangle_name_) = prefix_ + local;
    const auto unit = unit_named(attribute(model, "unit"));
    if (!unit) return unusable("its unit " + in_quotes(attribute(model, "unit")) + " is unknown");
    result_.unit_mm = *unit;
    if (auto done = check_extensions(model); !done) return tl::unexpected<Error>(done.error());
    for (const pugi::xml_node& child : model) {
      Result<void> done;
      if (is(child, "resources")) done = read_resources(child);
      if (is(child, "build")) done = read_references(child, "item", result_.items);
      if (!done) return tl::unexpected<Error>(done.error());
    }
    return std::move(result_);
  }

 private:
  bool is(const pugi::xml_node& node, std::string_view local) const {
    const std::string_view name = node.name();
    return name.size() == prefix_.size() + local.size() && name.starts_with(prefix_) && name.ends_with(local);
  }

  Result<void> check_extensions(const pugi::xml_node& model) {
    TextCursor prefixes(attribute(model, "requiredextensions"));
    std::size_t count = 0;
    for (prefixes.skip_to_word(); !prefixes.at_end(); prefixes.skip_to_word()) {
      if (++count > kMostExtensions) return unusable("it requires more than 100 extensions");
      const std::string prefix(prefixes.word());
      const std::string_view name_space = model.attribute(("xmlns:" + prefix).c_str()).value();
      if (!keeps_the_shape(name_space))
        return unusable("its shape needs the extension " + in_quotes(name_space.empty() ? prefix : name_space) +
                            ", which Aplomb cannot read",
                        "export it as a plain mesh");
    }
    return {};
  }

  Result<void> read_resources(const pugi::xml_node& resources) {
    for (const pugi::xml_node& node : resources) {
      if (!is(node, "object")) continue;
      const auto id = index_in(attribute(node, "id"));
      if (!id) return unusable("an object has no usable id");
      object_ = ", object " + std::to_string(*id);
      if (auto held = context_.hold(kObjectBytes); !held) return held;
      const auto [at, is_new] = result_.objects.try_emplace(*id);
      if (!is_new) return unusable("another object has the same id");
      if (auto done = read_object(node, at->second); !done) return done;
    }
    object_.clear();
    return {};
  }

  Result<void> read_object(const pugi::xml_node& node, ThreemfObject& object) {
    object.name = short_name(attribute(node, "name"));
    object.type = short_name(attribute(node, "type"));
    if (object.type.empty()) object.type = "model";
    if (auto held = context_.hold(object.name.size() + object.type.size()); !held) return held;
    for (const pugi::xml_node& child : node) {
      Result<void> done;
      if (is(child, "metadatagroup")) read_settings(child, "name", object);
      if (local_name(child.name()) == "settings") read_settings(child, "key", object);  // Cura 4.0 and before
      if (is(child, "mesh") || is(child, "components")) {
        if (object.is_known_shape) return unusable("it has two shapes");
        object.is_known_shape = true;
        done =
            is(child, "mesh") ? read_mesh(child, object.mesh) : read_references(child, "component", object.components);
      }
      if (!done) return done;
    }
    return {};
  }

  static void read_settings(const pugi::xml_node& list, std::string_view key, ThreemfObject& object) {
    for (const pugi::xml_node& node : list) {
      const std::string_view name = local_name(attribute(node, key)), value = node.text().get();
      for (const std::string_view kind : {"infill_mesh", "cutting_mesh", "support_mesh", "anti_overhang_mesh"})
        if (name == kind && (value == "True" || value == "true")) object.modifier = kind;
    }
  }

  Result<void> read_mesh(const pugi::xml_node& node, TriangleMesh& out) {
    GrowingMesh mesh(context_);
    for (const pugi::xml_node& list : node) {
      Result<void> done;
      if (is(list, "vertices")) done = read_vertices(list, mesh);
      else if (is(list, "triangles")) done = read_triangles(list, mesh);
      else context_.note("the elements " + in_quotes(list.name()) + " of its meshes were ignored");
      if (!done) return done;
    }
    out = mesh.take();
    context_.set_work_bytes(context_.work_bytes() + out.vertices.capacity() * sizeof(Vec3) +
                            out.triangles.capacity() * sizeof(Triangle));
    return {};
  }

  Result<void> read_vertices(const pugi::xml_node& list, GrowingMesh& mesh) {
    for (const pugi::xml_node& node : list) {
      if (vertex_name_ != node.name()) continue;
      const std::size_t index = mesh.mesh().vertices.size();
      if (index % 65536 == 0 && !context_.proceed(0.5)) return cancelled();
      std::optional<double> position[3];
      for (const pugi::xml_attribute& each : node.attributes()) {
        const char* name = each.name();
        if (name[0] >= 'x' && name[0] <= 'z' && name[1] == 0) position[name[0] - 'x'] = number_in(each.value());
      }
      if (!position[0] || !position[1] || !position[2])
        return unusable("vertex " + std::to_string(index) + " lacks a coordinate that is a finite number");
      if (!mesh.add_vertex(result_.unit_mm * Vec3{*position[0], *position[1], *position[2]})) return mesh.failure();
    }
    return {};
  }

  Result<void> read_triangles(const pugi::xml_node& list, GrowingMesh& mesh) {
    const std::size_t vertices = mesh.mesh().vertices.size();
    for (const pugi::xml_node& node : list) {
      if (triangle_name_ != node.name()) continue;
      const std::size_t index = mesh.mesh().triangles.size();
      if (index % 65536 == 0 && !context_.proceed(0.6)) return cancelled();
      std::optional<std::uint32_t> corners[3];
      for (const pugi::xml_attribute& each : node.attributes()) {
        const char* name = each.name();
        if (name[0] == 'v' && name[1] >= '1' && name[1] <= '3' && name[2] == 0)
          corners[name[1] - '1'] = index_in(each.value());
      }
      for (const auto& corner : corners)
        if (!corner || *corner >= vertices)
          return unusable("triangle " + std::to_string(index) + " has a corner that is none of its " +
                          std::to_string(vertices) + " vertices");
      if (!mesh.add_triangle({*corners[0], *corners[1], *corners[2]})) return mesh.failure();
    }
    return {};
  }

  /// Build items or components: an object, where it is found, and how it is moved.
  Result<void> read_references(const pugi::xml_node& list, std::string_view element,
                               std::vector<ThreemfReference>& out) {
    for (const pugi::xml_node& node : list) {
      if (!is(node, element)) continue;
      if (auto held = context_.hold(kReferenceBytes); !held) return held;
      ThreemfReference reference;
      const auto id = index_in(attribute(node, "objectid"));
      if (!id) return unusable("a " + std::string(element) + " has no usable objectid");
      reference.id = *id;
      reference.path = attribute(node, "path");
      if (reference.path.size() > kMostPath) return unusable("a " + std::string(element) + " has too long a path");
      reference.printable = attribute(node, "printable") != "0";
      if (const std::string_view transform = attribute(node, "transform"); !transform.empty())
        if (auto done = read_transform(transform, reference.transform); !done) return done;
      out.push_back(std::move(reference));
    }
    return {};
  }

  /// Twelve numbers, a row for the image of x, of y, of z, and the translation (3MF core specification, 3.3).
  Result<void> read_transform(std::string_view text, Affine3& transform) {
    TextCursor cursor(text);
    double m[12];
    for (double& each : m) {
      cursor.skip_to_word();
      const auto value = cursor.number();
      if (!value) return unusable("the transform " + in_quotes(text) + " is not twelve finite numbers");
      each = *value;
    }
    cursor.skip_to_word();
    if (!cursor.at_end()) return unusable("the transform " + in_quotes(text) + " is not twelve finite numbers");
    transform.linear = {{{{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}}}};
    transform.translation = result_.unit_mm * Vec3{m[9], m[10], m[11]};
    const double volume_factor = determinant(transform.linear);
    if (volume_factor == 0 || !std::isfinite(volume_factor))
      return unusable("the transform " + in_quotes(text) + " flattens the object");
    return {};
  }

  tl::unexpected<Error> unusable(std::string problem, std::string_view remedy = "export the model again") const {
    return context_.unusable("part " + in_quotes(part_) + object_, problem.append("; ").append(remedy));
  }

  ReadContext& context_;
  std::string_view part_;
  std::string prefix_;  // of the core namespace, with its colon
  std::string vertex_name_, triangle_name_;
  std::string object_;  // at hand, for messages
  ThreemfPart result_;
};

}  // namespace

Result<ThreemfPart> read_threemf_part(ReadContext& context, std::string_view name, std::string xml) {
  pugi::xml_document document;
  const std::size_t tree_bytes = tree_bytes_of(xml);
  if (auto parsed = parse_xml(context, name, xml, document); !parsed) return tl::unexpected<Error>(parsed.error());
  context.set_work_bytes(context.work_bytes() + tree_bytes);
  auto part = PartReader(context, name).read(document.document_element());
  context.set_work_bytes(context.work_bytes() - tree_bytes - xml.size());  // zip counted the text
  return part;
}

}  // namespace aplomb::detail
