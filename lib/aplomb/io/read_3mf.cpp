#include <algorithm>
#include <cmath>
#include <limits>

#include "aplomb/io/detail/readers.h"
#include "aplomb/io/detail/threemf_vendor.h"
#include "aplomb/io/detail/threemf_xml.h"

namespace aplomb::detail {
namespace {

constexpr int kMostLevels = 100;
constexpr double kMostInstances = 1e6;

/// Puts build items together from the objects of all model parts.
class Assembler {
 public:
  Assembler(ReadContext& context, ZipReader& zip, ThreemfVendor vendor)
      : context_(context), zip_(zip), vendor_(std::move(vendor)) {}

  Result<MeshFile> read(const std::string& root_name) {
    root_ = ZipReader::key_of(root_name);
    const auto root = part(root_);
    if (!root) return tl::unexpected<Error>(root.error());
    MeshFile file;
    file.format = "3MF";
    file.unit_mm = (*root)->unit_mm;
    file.unit_known = true;
    if ((*root)->items.empty())
      return context_.unusable("part " + in_quotes(root_),
                               "its build is empty, so that nothing is to be printed; export the model again");
    for (const ThreemfReference& item : (*root)->items)
      if (auto done = add_item(item, file); !done) return tl::unexpected<Error>(done.error());
    note_unused(**root);
    return file;
  }

 private:
  struct Key {
    std::string part;
    ResourceId id = 0;
    auto operator<=>(const Key&) const = default;
  };
  /// What an object amounts to when its components are written out. In floating point: 2^1000 is no trouble.
  struct Amount {
    double vertices = 0, triangles = 0, instances = 1;
    bool known = false;  // false while it is being added up: meeting it again is a cycle
  };

  static std::string text_of(const Key& key) {
    return "part " + in_quotes(key.part) + ", object " + std::to_string(key.id);
  }

  Key key_of(const ThreemfReference& reference, const std::string& from) const {
    return {reference.path.empty() ? from : ZipReader::key_of(reference.path), reference.id};
  }

  Result<const ThreemfPart*> part(const std::string& name) {
    if (const auto known = parts_.find(name); known != parts_.end()) return &known->second;
    auto xml = zip_.read(name);
    if (!xml) return tl::unexpected<Error>(xml.error());
    auto part = read_threemf_part(context_, name, std::move(*xml));
    if (!part) return tl::unexpected<Error>(part.error());
    if (name == root_)
      if (auto done = leave_out_volumes(*part); !done) return tl::unexpected<Error>(done.error());
    return &parts_.emplace(name, std::move(*part)).first->second;
  }

  /// Once for each object, however many items are made of it.
  Result<void> leave_out_volumes(ThreemfPart& root) {
    for (const auto& [id, ranges] : vendor_.left_out_triangles) {
      const auto found = root.objects.find(id);
      if (found == root.objects.end()) continue;
      if (!context_.proceed(0.8)) return cancelled();
      TriangleMesh& mesh = found->second.mesh;
      if (auto admitted = context_.hold(mesh.vertices.size() * (sizeof(Vec3) + sizeof(std::uint32_t)) +
                                        mesh.triangles.size() * (sizeof(Triangle) + sizeof(int)));
          !admitted)
        return admitted;
      mesh = without(mesh, ranges);
    }
    return {};
  }

  Result<const ThreemfObject*> object(const Key& key) {
    const auto holder = part(key.part);
    if (!holder) return tl::unexpected<Error>(holder.error());
    const auto found = (*holder)->objects.find(key.id);
    if (found == (*holder)->objects.end())
      return context_.unusable(text_of(key), "there is no such object; export the model again");
    return &found->second;
  }

  Result<Amount> amount(const Key& key, int level) {
    if (const auto known = amounts_.find(key); known != amounts_.end()) {
      if (known->second.known) return known->second;
      return context_.unusable(text_of(key), "it contains itself; export the model again");
    }
    if (level > kMostLevels)
      return context_.unusable(text_of(key), "its components are nested too deeply; export the model again");
    const auto found = object(key);
    if (!found) return tl::unexpected<Error>(found.error());
    if (!(*found)->is_known_shape)
      return context_.unusable(text_of(key), "it has neither a mesh nor components; export it as a plain mesh");
    amounts_[key] = {};
    Amount sum{static_cast<double>((*found)->mesh.vertices.size()),
               static_cast<double>((*found)->mesh.triangles.size()), 1, true};
    for (const ThreemfReference& component : (*found)->components) {
      auto inner = amount(key_of(component, key.part), level + 1);
      if (!inner) return inner;
      sum.vertices += inner->vertices;
      sum.triangles += inner->triangles;
      sum.instances += inner->instances;
    }
    return amounts_[key] = sum;
  }

  Result<void> add_item(const ThreemfReference& item, MeshFile& file) {
    const Key key = key_of(item, root_);
    used_.insert(key);
    const auto found = object(key);
    if (!found) return tl::unexpected<Error>(found.error());
    const std::string& type = (*found)->type;
    if (!item.printable || type == "support" || type == "solidsupport" || type == "other") {
      context_.note("object " + std::to_string(item.id) + " is " +
                    (item.printable ? "of the type " + in_quotes(type) : "marked as not printable") +
                    " and was ignored");
      return {};
    }
    const auto whole = amount(key, 0);
    if (!whole) return tl::unexpected<Error>(whole.error());
    MeshObject object{(*found)->name, {}};
    if (const auto name = vendor_.names.find(item.id); object.name.empty() && name != vendor_.names.end())
      object.name = name->second;
    // Its place in a vector that doubles, its name, and what the heap takes to keep those and a small mesh.
    context_.set_work_bytes(context_.work_bytes() + 3 * sizeof(MeshObject) + object.name.size() + 128);
    if (auto admitted = admit(*whole); !admitted) return admitted;
    object.mesh.vertices.reserve(static_cast<std::size_t>(whole->vertices));
    object.mesh.triangles.reserve(static_cast<std::size_t>(whole->triangles));
    if (auto done = append(key, item.transform, object.mesh); !done) return done;
    file.objects.push_back(std::move(object));
    return {};
  }

  /// Over all items so far, and before anything is copied.
  Result<void> admit(const Amount& item) {
    total_.vertices += item.vertices;
    total_.triangles += item.triangles;
    total_.instances += item.instances;
    const double most = 1e18;  // far over any budget, yet safe to convert
    if (total_.instances > kMostInstances)
      return fail(ErrorCode::over_budget,
                  context_.name() + ": its components make more than a million copies; simplify the model");
    return context_.admit(static_cast<std::size_t>(std::min(total_.vertices, most)),
                          static_cast<std::size_t>(std::min(total_.triangles, most)));
  }

  /// \pre amount(key) succeeded: no cycles, every reference is known.
  Result<void> append(const Key& key, const Affine3& transform, TriangleMesh& out) {
    const ThreemfObject& source = **object(key);
    if (!context_.proceed(0.9)) return cancelled();
    if (!source.modifier.empty()) {
      context_.note("object " + std::to_string(key.id) + " is marked " + in_quotes(source.modifier) +
                    " and was left out");
      return {};
    }
    if (auto done = append_mesh(key, source.mesh, transform, out); !done) return done;
    const auto left_out =
        key.part == root_ ? vendor_.left_out_components.find(key.id) : vendor_.left_out_components.end();
    for (const ThreemfReference& component : source.components) {
      if (left_out != vendor_.left_out_components.end() && left_out->second.contains(component.id)) continue;
      auto done = append(key_of(component, key.part), transform * component.transform, out);
      if (!done) return done;
    }
    return {};
  }

  Result<void> append_mesh(const Key& key, const TriangleMesh& mesh, const Affine3& transform, TriangleMesh& out) {
    const TriangleMesh moved = transformed(mesh, transform);
    for (const Vec3& v : moved.vertices)
      for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(v[axis]) <= std::numeric_limits<float>::max()))
          return context_.unusable(text_of(key),
                                   "its transforms move a vertex out of every range; export the model again");
    out = joined(std::move(out), moved);
    return {};
  }

  /// Without ranges of triangles and the vertices that only they use.
  static TriangleMesh without(const TriangleMesh& mesh,
                              const std::vector<std::pair<std::size_t, std::size_t>>& ranges) {
    constexpr std::uint32_t kUnused = 0xffffffff;
    const std::size_t count = mesh.triangles.size();
    std::vector<int> begun(count + 1);  // ranges that begin less those that have ended, as there may be many
    for (const auto& [first, last] : ranges) {
      if (first > last || first >= count) continue;
      ++begun[first];
      --begun[std::min(last, count - 1) + 1];
    }
    int open_ranges = 0;
    TriangleMesh kept;
    kept.vertices.reserve(mesh.vertices.size());
    kept.triangles.reserve(count);
    std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kUnused);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      open_ranges += begun[i];
      if (open_ranges > 0) continue;
      Triangle triangle = mesh.triangles[i];
      for (std::uint32_t& corner : triangle) {
        if (renumbered[corner] == kUnused) {
          renumbered[corner] = static_cast<std::uint32_t>(kept.vertices.size());
          kept.vertices.push_back(mesh.vertices[corner]);
        }
        corner = renumbered[corner];
      }
      kept.triangles.push_back(triangle);
    }
    return kept;
  }

  void note_unused(const ThreemfPart& root) {
    std::size_t unused = 0;
    for (const auto& [id, each] : root.objects)
      unused += !used_.contains({root_, id}) && !amounts_.contains({root_, id});
    if (unused > 0) context_.note(std::to_string(unused) + " objects that the build does not use were ignored");
  }

  ReadContext& context_;
  ZipReader& zip_;
  ThreemfVendor vendor_;
  std::string root_;
  std::map<std::string, ThreemfPart> parts_;
  std::map<Key, Amount> amounts_;
  std::set<Key> used_;
  Amount total_{0, 0, 0, true};
};

/// The name of the part that holds the build, from the package's relationships.
Result<std::string> root_part_name(ReadContext& context, ZipReader& zip) {
  constexpr std::string_view kRelationships = "_rels/.rels", kUsual = "3D/3dmodel.model";
  if (zip.has(kRelationships)) {
    auto xml = zip.read(kRelationships);
    if (!xml) return tl::unexpected<Error>(xml.error());
    pugi::xml_document document;
    if (auto parsed = parse_xml(context, kRelationships, *xml, document); !parsed)
      return tl::unexpected<Error>(parsed.error());
    for (const pugi::xml_node& each : document.document_element())
      if (attribute(each, "Type").ends_with("/3dmodel")) return std::string(attribute(each, "Target"));
  }
  if (!zip.has(kUsual)) return context.unusable("", "the zip holds no 3D model; export the model again");
  context.note("the package names no root model; its usual one was read");
  return std::string(kUsual);
}

}  // namespace

Result<MeshFile> read_3mf(ReadContext& context) {
  auto zip = ZipReader::open(context);
  if (!zip) return tl::unexpected<Error>(zip.error());
  const auto root = root_part_name(context, *zip);
  if (!root) return tl::unexpected<Error>(root.error());
  auto vendor = read_threemf_vendor(context, *zip);
  if (!vendor) return tl::unexpected<Error>(vendor.error());
  return Assembler(context, *zip, std::move(*vendor)).read(*root);
}

}  // namespace aplomb::detail
