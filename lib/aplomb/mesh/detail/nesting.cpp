#include "aplomb/mesh/detail/nesting.h"

#include <algorithm>
#include <limits>
#include <string>

#include "aplomb/adapters/cgal/exact_predicates.h"
#include "aplomb/mesh/detail/crossings.h"

namespace aplomb::detail {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFF;
constexpr std::size_t few_triangles = 32;       // looked at one by one
constexpr std::uint32_t triangles_a_step = 16;  // about a microsecond

/// Components of which every edge is run along as often one way as the other: nothing below or beside winds round.
std::vector<bool> cycles(const TriangleMesh& mesh, const EdgeTable& edges, const Components& components,
                         const Pulse& pulse) {
  std::vector<bool> are_cycles(components.count, true);
  const auto weigh = [&](std::uint32_t low, std::uint32_t, std::span<const Corner> corners) {
    int surplus = 0;
    for (const Corner c : corners) surplus += vertex_at(mesh, c) == low ? 1 : -1;
    if (surplus != 0) are_cycles[components.of_triangle[corners[0] / 3]] = false;
  };
  edges.for_each(weigh, pulse);
  return are_cycles;
}

bool is_degenerate(const TriangleMesh& mesh, const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
         adapters::are_collinear(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
}

/// Whether triangles of two components share a vertex or cross.
bool touch(const TriangleMesh& mesh, const Triangle& s, const Triangle& t) {
  if (std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end()) return true;
  return !is_degenerate(mesh, s) && !is_degenerate(mesh, t) && cross(mesh, s, t);
}

/// For for_each_enclosure(): all of them.
constexpr auto everywhere = [](const BoxTree&) {
  return [](std::uint32_t, std::uint32_t, std::uint32_t) { return true; };
};

}  // namespace

/// Counts steps, reports, and says when it is enough.
class Nesting::Effort {
 public:
  Effort(const Job& job, std::size_t most, std::uint32_t count) : job_(job), most_(most), count_(count) {}

  /// To be asked for every step; false: leave off.
  bool goes_on() {
    if (++steps_ % 65536 == 0 && ending_ == Ending::none) ask();
    return ending_ == Ending::none;
  }
  /// To be told which component is at work; false: leave off.
  bool begins(std::uint32_t component) {
    at_ = component;
    if (component == 0) ask();
    return goes_on();
  }
  Result<void> result() const {
    if (ending_ == Ending::cancelled) return cancelled();
    if (ending_ == Ending::too_much)
      return fail(ErrorCode::unusable_input,
                  "there are " + std::to_string(count_) +
                      " separate surfaces, which lie in and across one another too often to be sorted out; unite them "
                      "or leave out inner ones in a modeller, or split the file");
    return {};
  }

 private:
  enum class Ending { none, cancelled, too_much };

  void ask() {
    if (steps_ > most_) ending_ = Ending::too_much;
    else if (!job_.report(static_cast<double>(at_) / count_, "check")) ending_ = Ending::cancelled;
  }

  const Job& job_;
  std::size_t most_, steps_ = 0;
  std::uint32_t count_, at_ = 0;
  Ending ending_ = Ending::none;
};

/// Which nodes of a tree hold components of one set alone, found out as they are passed: sets only grow.
class Nesting::Lumps {
 public:
  Lumps(const BoxTree& tree, DisjointSets& sets) : tree_(tree), sets_(sets) {
    for (std::uint32_t level = 0; level < tree.levels(); ++level) members_.emplace_back(tree.nodes(level), none);
  }

  bool is_all_of(std::uint32_t component, std::uint32_t level, std::uint32_t node) {
    std::uint32_t& member = members_[level][node];
    if (member == none) member = level == 0 ? member_of_leaf(node) : member_of_children(level - 1, 2 * node);
    return member != none && sets_.find(member) == sets_.find(component);
  }

 private:
  std::uint32_t member_of_leaf(std::uint32_t leaf) {
    const auto items = tree_.items_of(leaf);
    const std::uint32_t set = sets_.find(items[0]);
    return std::all_of(items.begin(), items.end(), [&](std::uint32_t c) { return sets_.find(c) == set; }) ? set : none;
  }
  std::uint32_t member_of_children(std::uint32_t level, std::uint32_t first) {
    const std::uint32_t a = members_[level][first];
    if (a == none || first + 1 == tree_.nodes(level)) return a;
    const std::uint32_t b = members_[level][first + 1];
    return b != none && sets_.find(a) == sets_.find(b) ? a : none;
  }

  const BoxTree& tree_;
  DisjointSets& sets_;
  std::vector<std::vector<std::uint32_t>> members_;  // by level; none: several sets, as far as is known
};

Nesting::Nesting(const TriangleMesh& mesh, const EdgeTable& edges, const Components& components, const Pulse& pulse)
    : mesh_(mesh),
      starts_(components.count + 1),
      triangles_(mesh.triangles.size()),
      boxes_(components.count),
      trees_(components.count) {
  for (const std::uint32_t c : components.of_triangle) ++starts_[c + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::size_t> ends(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % triangles_a_step == 0 && !pulse.goes_on()) return;
    const std::uint32_t c = components.of_triangle[t];
    const FloatBox box = box_of(mesh, mesh.triangles[t]);
    boxes_[c] = ends[c] == starts_[c] ? box : united(boxes_[c], box);
    triangles_[ends[c]++] = t;
  }
  columns_ = boxes_;
  const std::vector<bool> are_cycles = cycles(mesh, edges, components, pulse);
  for (std::uint32_t c = 0; c < count(); ++c)
    if (!are_cycles[c]) columns_[c].min[2] = std::numeric_limits<float>::lowest();
}

Nesting::Effort Nesting::effort(const Job& job) const {
  return {job, 50'000'000 + 500 * mesh_.triangles.size(), count()};
}

/// Calls visit(t) for the triangles of a component whose box satisfies `meets`, until that or the effort says no.
template <class Meets, class Visit>
void Nesting::for_each_triangle(std::uint32_t component, Effort& effort, Meets&& meets, Visit&& visit) {
  const std::span<const std::uint32_t> triangles = triangles_of(component);
  const auto seen = [&](std::uint32_t i, const FloatBox& box) {
    if (effort.goes_on() && meets(box)) visit(triangles[i]);
  };
  if (triangles.size() <= few_triangles) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i) seen(i, box_of(mesh_, mesh_.triangles[triangles[i]]));
    return;
  }
  std::unique_ptr<BoxTree>& tree = trees_[component];
  if (!tree) {
    std::vector<FloatBox> boxes;
    boxes.reserve(triangles.size());
    for (const std::uint32_t t : triangles) boxes.push_back(box_of(mesh_, mesh_.triangles[t]));
    tree = std::make_unique<BoxTree>(boxes);
  }
  tree->walk([&](std::uint32_t, std::uint32_t, const FloatBox& box) { return effort.goes_on() && meets(box); }, seen);
}

bool Nesting::meet(std::uint32_t a, std::uint32_t b, Effort& effort) {
  if (triangles_of(a).size() > triangles_of(b).size()) std::swap(a, b);
  bool met = false;
  const auto near_b = [&](const FloatBox& box) { return !met && box.meets(boxes_[b]); };
  for_each_triangle(a, effort, near_b, [&](std::uint32_t s) {
    const Triangle& first = mesh_.triangles[s];
    const FloatBox around = box_of(mesh_, first);
    for_each_triangle(
        b, effort, [&](const FloatBox& box) { return !met && box.meets(around); },
        [&](std::uint32_t t) { met = touch(mesh_, first, mesh_.triangles[t]); });
  });
  return met;
}

/// Joins the components of pairs whose boxes meet and for which are_one(a, b, effort) holds; not asked where they are
/// joined already.
template <class AreOne>
Result<void> Nesting::join_pairs(DisjointSets& sets, const Job& job, AreOne&& are_one) {
  if (count() < 2) return {};
  const BoxTree tree(boxes_);
  Lumps lumps(tree, sets);
  Effort effort = this->effort(job);
  for (std::uint32_t c = 0; c < count() && effort.begins(c); ++c)
    tree.walk(
        [&](std::uint32_t level, std::uint32_t node, const FloatBox& box) {
          return effort.goes_on() && box.meets(boxes_[c]) && !lumps.is_all_of(c, level, node);
        },
        [&](std::uint32_t other, const FloatBox& box) {
          if (other > c && box.meets(boxes_[c]) && sets.find(other) != sets.find(c) && are_one(c, other, effort))
            sets.join(c, other);
        });
  return effort.result();
}

Result<DisjointSets> Nesting::touching(const Job& job) {
  DisjointSets sets(count());
  const auto are_one = [&](std::uint32_t a, std::uint32_t b, Effort& effort) { return meet(a, b, effort); };
  return join_pairs(sets, job, are_one).map([&] { return std::move(sets); });
}

Result<DisjointSets> Nesting::connected(const Job& job) {
  DisjointSets sets(count());
  // All three questions at once: where one is answered for all, the others would be asked of every pair in vain.
  const auto are_one = [&](std::uint32_t a, std::uint32_t b, Effort& effort) {
    return winding(a, place_of(b), effort) != 0 || winding(b, place_of(a), effort) != 0 || meet(a, b, effort);
  };
  if (const auto joined = join_pairs(sets, job.part(0, 0.7), are_one); !joined) return tl::unexpected(joined.error());
  if (const auto joined = join_enclosed(sets, job.part(0.7, 1)); !joined) return tl::unexpected(joined.error());
  return sets;
}

/// Of a component round a point: the crossings of a ray straight up, with their signs.
int Nesting::winding(std::uint32_t component, Vec3 p, Effort& effort) {
  const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
  const auto above = [&](const FloatBox& box) {
    return box.min[0] <= x && x <= box.max[0] && box.min[1] <= y && y <= box.max[1] && z <= box.max[2];
  };
  int sum = 0;
  for_each_triangle(component, effort, above,
                    [&](std::uint32_t t) { sum += crossing_above(mesh_, mesh_.triangles[t], p); });
  return sum;
}

/// Calls visit(component, enclosing one, winding) where that is not 0; enter(tree)(component, level, node) may say no.
template <class Enter, class Visit>
Result<void> Nesting::for_each_enclosure(const Job& job, Enter&& enter, Visit&& visit) {
  if (count() < 2) return {};
  const BoxTree tree(columns_);
  Effort effort = this->effort(job);
  auto goes_in = enter(tree);
  for (std::uint32_t c = 0; c < count() && effort.begins(c); ++c) {
    const Vec3 p = place_of(c);
    const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
    const FloatBox point{{x, y, z}, {x, y, z}};
    tree.walk([&](std::uint32_t level, std::uint32_t node,
                  const FloatBox& box) { return effort.goes_on() && box.meets(point) && goes_in(c, level, node); },
              [&](std::uint32_t other, const FloatBox& box) {
                if (other == c || !box.meets(point)) return;
                if (const int around = winding(other, p, effort); around != 0) visit(c, other, around);
              });
  }
  return effort.result();
}

/// Of open components the ray up may pass those whose boxes lie above.
Result<void> Nesting::join_enclosed(DisjointSets& sets, const Job& job) {
  const auto enter = [&](const BoxTree& tree) {
    return [lumps = Lumps(tree, sets)](std::uint32_t c, std::uint32_t level, std::uint32_t node) mutable {
      return !lumps.is_all_of(c, level, node);
    };
  };
  return for_each_enclosure(job, enter, [&](std::uint32_t c, std::uint32_t other, int) { sets.join(c, other); });
}

Result<std::vector<std::vector<Enclosure>>> Nesting::enclosures(const Job& job) {
  std::vector<std::vector<Enclosure>> all(count());
  const auto kept = for_each_enclosure(job, everywhere, [&](std::uint32_t c, std::uint32_t other, int around) {
    all[c].push_back({other, around});
  });
  if (!kept) return tl::unexpected(kept.error());
  for (std::vector<Enclosure>& enclosing : all)
    std::sort(enclosing.begin(), enclosing.end(), [](Enclosure a, Enclosure b) { return a.component < b.component; });
  return all;
}

Result<Nesting::Windings> Nesting::windings(const Job& job) {
  Windings all{std::vector<int>(count()), DisjointSets(count())};
  const auto summed = for_each_enclosure(job, everywhere, [&](std::uint32_t c, std::uint32_t other, int around) {
    all.sums[c] += around;
    all.sets.join(c, other);
  });
  if (!summed) return tl::unexpected(summed.error());
  return all;
}

PrintNumbers numbered(Components components, DisjointSets& sets) {
  PrintNumbers prints{std::move(components.of_triangle), 0};
  std::vector<std::uint32_t> number(components.count);
  for (std::uint32_t c = 0; c < components.count; ++c) {
    const std::uint32_t root = sets.find(c);  // the smallest member
    number[c] = root == c ? prints.count++ : number[root];
  }
  for (std::uint32_t& print : prints.of_triangle) print = number[print];
  return prints;
}

}  // namespace aplomb::detail
