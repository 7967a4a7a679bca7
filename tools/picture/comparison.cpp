#include "comparison.h"

#include <algorithm>
#include <cassert>

#include "figure.h"

namespace aplomb::picture {
namespace {

/// A figure in a pose, upward z, and what is said of it.
struct Posed {
  Subject subject;
  std::string verdict;
  Vec3 heading{1, 0, 0};  ///< where it would fall, or across the threads
  bool has_plate = true;
  Affine3 down{};  ///< from the mesh as it came
};

Result<Posed> posed(const TriangleMesh& mesh, const Moments& inserts, const Pose& pose) {
  if (const HangingPose* hanging = pose.hanging())
    return hung(mesh, *hanging, inserts).map([](Hung hung) {
      return Posed{std::move(hung.subject), std::move(hung.verdict), {1, 0, 0}, false, hung.down};
    });
  return stood_up(mesh, *pose.standing(), inserts).map([](const Figure& figure) {
    return Posed{drawn(figure), verdict(figure), figure.standing.stability.heading, true, figure.down};
  });
}

/// Both figures fit into it, each in its middle.
Box3 frame_for(const Box3& own, Vec3 size) {
  const Vec3 low{0.5 * (own.min.x + own.max.x - size.x), 0.5 * (own.min.y + own.max.y - size.y), own.min.z};
  return {low, low + size};
}

class Row {
 public:
  Row(std::vector<Posed> figures, int size) : figures_(std::move(figures)) {
    for (const Posed& figure : figures_)
      for (int axis = 0; axis < 3; ++axis)
        size_[axis] = std::max(size_[axis], bounding_box(figure.subject.mesh).size()[axis]);
    view_.width = size;
    view_.height = size;
    view_.plate = figures_.front().has_plate;
    view_.azimuth_rad = azimuth_for_rad(figures_.front().heading);
  }

  Result<Image> draw(const std::string& name, const Job& job) const {
    const Posed &first = figures_.front(), &last = figures_.back();
    const std::string head = name.empty() ? "" : name + ": ";
    const bool is_pair = figures_.size() > 1;
    struct Wanted {
      const Posed& figure;
      bool is_open;
      std::string text;
    };
    std::vector<Wanted> wanted;
    if (is_pair) wanted.push_back({first, false, head + "before: " + first.verdict});
    wanted.push_back({last, true, "inside"});
    wanted.push_back({last, false, (is_pair ? "after: " : head) + last.verdict});
    std::vector<Panel> panels;
    for (const Wanted& panel : wanted) {
      const double from = double(panels.size()) / double(wanted.size());
      auto image = picture_of(panel.figure, panel.is_open, job.part(from, from + 1.0 / double(wanted.size())));
      if (!image) return image;
      panels.push_back({std::move(*image), panel.text});
    }
    return side_by_side(panels);
  }

 private:
  Result<Image> picture_of(const Posed& figure, bool is_open, const Job& job) const {
    View view = view_;
    view.frame_mm = frame_for(bounding_box(figure.subject.mesh), size_);
    if (is_open) view.cut = section_along(*figure.subject.com_mm, figures_.front().heading, view.azimuth_rad);
    return render(figure.subject, view, job).map([](Rendering drawn) { return std::move(drawn.image); });
  }

  std::vector<Posed> figures_;
  Vec3 size_;
  View view_;
};

/// A mesh, and what weighs besides it.
struct Model {
  const TriangleMesh* mesh = nullptr;
  Moments inserts{};
};

Result<Image> pictures(const std::vector<Model>& models, const std::vector<Pose>& poses, int size,
                       const std::vector<Mark>& marks, const Job& job) {
  assert(!poses.empty() && size > 0);
  std::vector<Image> rows;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    std::vector<Posed> figures;
    for (const auto& [mesh, inserts] : models) {
      auto figure = posed(*mesh, inserts, poses[n]);
      if (!figure) return tl::unexpected(figure.error());
      figures.push_back(std::move(*figure));
    }
    for (const Mark& mark : marks)
      figures.back().subject.marks.push_back({figures.back().down * mark.at_mm, mark.text});
    const double share = 1 / static_cast<double>(poses.size());
    const double from = static_cast<double>(n) * share;
    auto row = Row(std::move(figures), size).draw(poses[n].name, job.part(from, from + share));
    if (!row) return row;
    rows.push_back(std::move(*row));
  }
  return one_below_another(rows);
}

}  // namespace

Result<Image> before_and_after(const TriangleMesh& before, const TriangleMesh& after, const std::vector<Pose>& poses,
                               int size, const std::vector<Mark>& marks, const Job& job, const Moments& inserts) {
  return pictures({{&before, {}}, {&after, inserts}}, poses, size, marks, job);
}

Result<Image> as_it_is(const TriangleMesh& mesh, const std::vector<Pose>& poses, int size,
                       const std::vector<Mark>& marks, const Job& job) {
  return pictures({{&mesh, {}}}, poses, size, marks, job);
}

}  // namespace aplomb::picture
