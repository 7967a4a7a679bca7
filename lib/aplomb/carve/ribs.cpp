#include "aplomb/carve/ribs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "aplomb/volume/carvable_blocks.h"

namespace aplomb {
namespace {

constexpr int directions = 12, phases = 5;
constexpr double beyond_mm = 1.5;  // that a rib goes on past what it holds, so that none is a needle

/// Parallel ribs: those at first_mm + k pitch_mm along the normal.
struct Family {
  Vec2 normal;
  double first_mm = 0, pitch_mm = 1;
  int count = 1;

  double across_mm(Vec2 p) const { return p.x * normal.x + p.y * normal.y; }
  double along_mm(Vec2 p) const { return p.y * normal.x - p.x * normal.y; }
  /// Distance to the nearest rib's middle.
  double to_rib_mm(Vec2 p) const {
    const double k = std::round((across_mm(p) - first_mm) / pitch_mm);
    return std::abs(across_mm(p) - first_mm - pitch_mm * std::clamp(k, 0.0, double(count - 1)));
  }
};

/// A piece of the ceiling, its cells' places and what keeping them costs.
struct Cells {
  std::vector<Vec2> places;
  std::vector<double> tops_mm;
  std::vector<ColumnCosts::Column> below;
  double cell_mm = 1;
};

double cost_of(const Family& family, const Cells& cells, double thick_mm) {
  double sum = 0;
  for (std::size_t i = 0; i < cells.places.size(); ++i) {
    const double share = (thick_mm / 2 - family.to_rib_mm(cells.places[i])) / cells.cell_mm + 0.5;
    sum += cells.below[i].cost * std::clamp(share, 0.0, 1.0);
  }
  return sum;
}

Family cheapest(const Cells& cells, const RibOptions& options) {
  Family best;
  double least = std::numeric_limits<double>::infinity();
  for (int direction = 0; direction < directions; ++direction) {
    const double angle = std::numbers::pi * direction / directions;
    Family family{{std::cos(angle), std::sin(angle)}, 0, options.slot_mm + options.thick_mm, 1};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec2 p : cells.places) {
      low = std::min(low, family.across_mm(p) - cells.cell_mm / 2);
      high = std::max(high, family.across_mm(p) + cells.cell_mm / 2);
    }
    family.count = std::max(1, static_cast<int>(std::ceil((high - low - options.slot_mm) / family.pitch_mm)));
    const double slack = (family.count + 1) * options.slot_mm + family.count * options.thick_mm - (high - low);
    for (int phase = 0; phase < phases; ++phase) {
      const double shift = std::min(slack, options.slot_mm) * phase / (phases - 1);
      family.first_mm = low + options.slot_mm + options.thick_mm / 2 - shift;
      const double cost = cost_of(family, cells, options.thick_mm);
      if (cost < least) least = cost, best = family;
    }
  }
  return best;
}

/// The stretches of a rib that have something to hold, and how high.
struct Stretch {
  double begin_mm = 0, end_mm = 0, top_mm = 0;
};

std::vector<Stretch> stretches(const Family& family, int rib, const Cells& cells, const RibOptions& options) {
  const double middle = family.first_mm + rib * family.pitch_mm;
  std::vector<Stretch> marks;
  for (std::size_t i = 0; i < cells.places.size(); ++i) {
    const Vec2 p = cells.places[i];
    if (std::abs(family.across_mm(p) - middle) > options.slot_mm + options.thick_mm / 2) continue;
    const double along = family.along_mm(p);
    marks.push_back({along - beyond_mm, along + beyond_mm, cells.tops_mm[i]});
  }
  std::ranges::sort(marks, {}, &Stretch::begin_mm);
  std::vector<Stretch> joined;
  for (const Stretch& mark : marks) {
    if (joined.empty() || mark.begin_mm > joined.back().end_mm + 2 * beyond_mm) {
      joined.push_back(mark);
      continue;
    }
    joined.back().end_mm = std::max(joined.back().end_mm, mark.end_mm);
    joined.back().top_mm = std::max(joined.back().top_mm, mark.top_mm);
  }
  return joined;
}

/// A pointed opening in a rib: all below its two slopes, between two legs.
struct Arch {
  double begin_mm = 0, end_mm = 0, apex_mm = 0, top_mm = 0, steepness = 1;
  double gain = 0;

  double height_mm(double along) const { return top_mm - steepness * std::abs(along - apex_mm); }
  double depth_mm(double along, double z) const {
    const double below = (height_mm(along) - z) / std::hypot(1.0, steepness);
    return std::min({below, along - begin_mm, end_mm - along});
  }
};

/// Cells that lie under a rib.
struct Hold {
  double along_mm = 0, top_mm = 0;
  ColumnCosts::Column below;
};

constexpr std::array<double, 5> apexes{0.5, 0.35, 0.65, 0.2, 0.8};
constexpr int most_arches = 8;

/// The arch between two legs that gains most.
Arch best_arch(double begin, double end, const std::vector<Hold>& holds, const RibOptions& options) {
  Arch best;
  for (const double share : apexes) {
    Arch arch{begin, end, begin + share * (end - begin), 1e9, std::tan(options.slope_deg * std::numbers::pi / 180), 0};
    for (const Hold& hold : holds)
      if (hold.along_mm > begin && hold.along_mm < end)
        arch.top_mm = std::min(
            arch.top_mm, hold.top_mm - 2 * options.thick_mm + arch.steepness * std::abs(hold.along_mm - arch.apex_mm));
    for (const Hold& hold : holds) {
      if (!(hold.along_mm > begin && hold.along_mm < end) || hold.below.cost <= 0) continue;
      const double open = std::max(0.0, arch.height_mm(hold.along_mm) - hold.below.floor_mm);
      arch.gain += hold.below.cost * open / std::max(open, hold.top_mm - hold.below.floor_mm);
    }
    if (arch.gain > best.gain) best = arch;
  }
  return best;
}

std::vector<Arch> best_arches(const Stretch& stretch, const std::vector<Hold>& holds, const RibOptions& options) {
  std::vector<Arch> best;
  double most = 0;
  const double leg = 2 * options.thick_mm;
  for (int count = 1; count <= most_arches && options.slope_deg < 85; ++count) {
    const double width = (stretch.end_mm - stretch.begin_mm - (count + 1) * leg) / count;
    if (width < leg) break;
    std::vector<Arch> arches;
    double gain = 0;
    for (int i = 0; i < count; ++i) {
      const double begin = stretch.begin_mm + leg + i * (width + leg);
      const Arch arch = best_arch(begin, begin + width, holds, options);
      if (arch.gain > 0) arches.push_back(arch);
      gain += arch.gain;
    }
    if (gain > most) most = gain, best = std::move(arches);
  }
  return best;
}

std::vector<Hold> holds_of(const Family& family, double middle_mm, const Cells& cells, double thick_mm) {
  std::vector<Hold> holds;
  for (std::size_t i = 0; i < cells.places.size(); ++i)
    if (std::abs(family.across_mm(cells.places[i]) - middle_mm) <= thick_mm / 2 + cells.cell_mm)
      holds.push_back({family.along_mm(cells.places[i]), cells.tops_mm[i], cells.below[i]});
  return holds;
}

KeptPart rib_part(const Family& family, int rib, const Stretch& stretch, const Cells& cells, const RibOptions& options) {
  const double middle = family.first_mm + rib * family.pitch_mm, thick = options.thick_mm, floor = options.floor_mm;
  const double top = stretch.top_mm + 2 * thick;
  KeptPart part;
  for (const double across : {middle - thick / 2, middle + thick / 2})
    for (const double along : {stretch.begin_mm, stretch.end_mm})
      for (const double z : {floor, top})
        part.box_mm.add({across * family.normal.x - along * family.normal.y,
                         across * family.normal.y + along * family.normal.x, z});
  const std::vector<Arch> arches = best_arches(stretch, holds_of(family, middle, cells, thick), options);
  part.depth_mm = [=](Vec3 p) {
    const double along = family.along_mm({p.x, p.y});
    double depth = thick / 2 - std::abs(family.across_mm({p.x, p.y}) - middle);
    depth = std::min({depth, along - stretch.begin_mm, stretch.end_mm - along});
    for (const Arch& arch : arches) depth = std::min(depth, -arch.depth_mm(along, p.z));
    return std::min({depth, top - p.z, p.z - floor});
  };
  return part;
}

}  // namespace

ColumnCosts::ColumnCosts(const SolidVolume& volume, const AffineForm& kept) : frame_(volume.frame()) {
  const std::vector<CarvableBlock> blocks = carvable_blocks(volume);
  for (const CarvableBlock& block : blocks) {
    columns_ = std::max(columns_, block.origin[0] + CarvableBlock::size);
    rows_ = std::max(rows_, block.origin[1] + CarvableBlock::size);
  }
  in_order_.assign(static_cast<std::size_t>(columns_) * rows_, {});
  for (const CarvableBlock& block : blocks)
    for (int cell = 0; cell < CarvableBlock::cells; ++cell) {
      const double share = block.shares.empty() ? 1 : block.shares[cell];
      const int i = block.origin[0] + cell / 64, j = block.origin[1] + cell / 8 % 8, k = block.origin[2] + cell % 8;
      const Vec3 least = frame_.position_mm({i, j, k});
      const double l = kept(least + 0.5 * frame_.voxel_mm * Vec3{1, 1, 1});
      if (i < 0 || j < 0 || share == 0 || l >= 0) continue;
      Column& column = in_order_[static_cast<std::size_t>(j) * columns_ + i];
      column.floor_mm = column.cost > 0 ? std::min(column.floor_mm, least.z) : least.z;
      column.cost -= share * l * frame_.voxel_mm;
    }
}

ColumnCosts::Column ColumnCosts::at(Vec2 point) const {
  const int i = static_cast<int>(std::floor((point.x - frame_.origin_mm.x) / frame_.voxel_mm));
  const int j = static_cast<int>(std::floor((point.y - frame_.origin_mm.y) / frame_.voxel_mm));
  if (i < 0 || j < 0 || i >= columns_ || j >= rows_) return {};
  return in_order_[static_cast<std::size_t>(j) * columns_ + i];
}

std::vector<KeptPart> ribs_under(const FlatCeiling& ceiling, const std::vector<int>& wide, const ColumnCosts& costs,
                                 const RibOptions& options) {
  Cells cells;
  cells.cell_mm = ceiling.cell_mm;
  for (const int cell : wide) {
    cells.places.push_back(ceiling.middle_mm(cell));
    cells.tops_mm.push_back(ceiling.top_mm[cell]);
    cells.below.push_back(costs.at(cells.places.back()));
  }
  const Family family = cheapest(cells, options);
  std::vector<KeptPart> ribs;
  for (int rib = 0; rib < family.count; ++rib)
    for (const Stretch& stretch : stretches(family, rib, cells, options))
      ribs.push_back(rib_part(family, rib, stretch, cells, options));
  return ribs;
}

}  // namespace aplomb
