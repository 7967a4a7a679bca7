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
  Vec2 place(double across, double along) const {
    return {across * normal.x - along * normal.y, across * normal.y + along * normal.x};
  }
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

constexpr std::array<double, 7> apexes{0.5, 0.35, 0.65, 0.2, 0.8, 0, 1};
constexpr int most_arches = 6;
constexpr double most_reach_mm = 40;  // of an arch past the ceiling, to a wall
constexpr double everywhere_mm = 1e9;

/// Where a rib is, and the arches in it.
struct Rib {
  Stretch stretch;
  std::vector<Arch> arches;
  double gain = 0;
};

/// Cuts arches out of one rib.
class RibCutter {
 public:
  RibCutter(const Family& family, double middle_mm, const Stretch& stretch, const Cells& cells,
            const ColumnCosts& costs, const RibOptions& options)
      : family_(family), middle_mm_(middle_mm), stretch_(stretch), costs_(costs), options_(options) {
    double floor = stretch.top_mm;
    for (std::size_t i = 0; i < cells.places.size(); ++i) {
      if (std::abs(family.across_mm(cells.places[i]) - middle_mm) > options.thick_mm / 2 + cells.cell_mm) continue;
      const double along = family.along_mm(cells.places[i]);
      if (along < stretch.begin_mm || along > stretch.end_mm) continue;
      holds_.push_back({along, cells.tops_mm[i], cells.below[i]});
      if (cells.below[i].cost > 0) floor = std::min(floor, cells.below[i].floor_mm);
    }
    leg_mm_ = std::max(2 * options.thick_mm, (stretch.top_mm - floor) / 4);
  }

  Rib cut() const {
    Rib best{stretch_, {}, 0};
    if (options_.slope_deg > 85) return best;
    for (int count = 1; count <= most_arches; ++count)
      for (const bool legs_first : {false, true})
        for (const bool legs_last : {false, true})
          if (Rib rib = with_arches(count, legs_first, legs_last); rib.gain > best.gain) best = std::move(rib);
    return best;
  }

 private:
  /// With legs at its ends, or leaning on what is beyond them.
  Rib with_arches(int count, bool leg_first, bool leg_last) const {
    Rib rib{stretch_, {}, 0};
    const double low = stretch_.begin_mm + (leg_first ? leg_mm_ : 0), high = stretch_.end_mm - (leg_last ? leg_mm_ : 0);
    const double width = (high - low - (count - 1) * leg_mm_) / count;
    if (width < leg_mm_) return rib;
    for (int i = 0; i < count; ++i) {
      const double begin = low + i * (width + leg_mm_);
      Arch arch = best_arch(begin, begin + width);
      if (!(arch.gain > 0)) return {stretch_, {}, 0};
      rib.gain += arch.gain;
      if (i == 0 && !leg_first && !lean(arch, -1, rib)) return {stretch_, {}, 0};
      if (i + 1 == count && !leg_last && !lean(arch, 1, rib)) return {stretch_, {}, 0};
      rib.arches.push_back(arch);
    }
    return rib;
  }

  Arch best_arch(double begin, double end) const {
    Arch best;
    for (const double share : apexes) {
      Arch arch{begin,
                end,
                begin + share * (end - begin),
                everywhere_mm,
                std::tan(options_.slope_deg * std::numbers::pi / 180),
                0};
      const auto spans = [&](const Hold& hold) { return hold.along_mm > begin && hold.along_mm < end; };
      for (const Hold& hold : holds_)
        if (spans(hold))
          arch.top_mm = std::min(arch.top_mm, hold.top_mm - 2 * options_.thick_mm +
                                                  arch.steepness * std::abs(hold.along_mm - arch.apex_mm));
      for (const Hold& hold : holds_)
        if (spans(hold)) arch.gain += open_cost(hold.below, hold.top_mm, arch.height_mm(hold.along_mm));
      if (arch.gain > best.gain) best = arch;
    }
    return best;
  }

  /// What is gained in a column, of a rib as wide as a cell, that is open up to a height.
  static double open_cost(const ColumnCosts::Column& below, double top_mm, double height_mm) {
    const double open = std::max(0.0, height_mm - below.floor_mm);
    return below.cost <= 0 || open == 0 ? 0 : below.cost * open / std::max(open, top_mm - below.floor_mm);
  }

  /// Follows an arch past the rib's end until it meets material, and makes the rib as long. \return whether it does.
  bool lean(Arch& arch, int way, Rib& rib) const {
    const double step = 0.5 * options_.thick_mm, start = way < 0 ? stretch_.begin_mm : stretch_.end_mm;
    for (double reach = 0; reach <= most_reach_mm; reach += step) {
      const double along = start + way * reach, height = arch.height_mm(along);
      const ColumnCosts::Column below = costs_.at(family_.place(middle_mm_, along));
      if (below.cost <= 0 || height >= below.top_mm || height <= below.floor_mm) {
        (way < 0 ? arch.begin_mm : arch.end_mm) = way * everywhere_mm;
        (way < 0 ? rib.stretch.begin_mm : rib.stretch.end_mm) = along + way * options_.thick_mm;
        return true;
      }
      rib.gain -= (below.cost - open_cost(below, below.top_mm, height)) * step / options_.thick_mm;
    }
    return false;
  }

  const Family& family_;
  const double middle_mm_;
  const Stretch& stretch_;
  const ColumnCosts& costs_;
  const RibOptions& options_;
  std::vector<Hold> holds_;
  double leg_mm_ = 2;
};

KeptPart rib_part(const Family& family, double middle, const Rib& rib, const RibOptions& options) {
  const double thick = options.thick_mm, floor = options.floor_mm, top = rib.stretch.top_mm + 2 * thick;
  KeptPart part;
  for (const double across : {middle - thick / 2, middle + thick / 2})
    for (const double along : {rib.stretch.begin_mm, rib.stretch.end_mm})
      for (const double z : {floor, top}) {
        const Vec2 place = family.place(across, along);
        part.box_mm.add({place.x, place.y, z});
      }
  part.depth_mm = [=](Vec3 p) {
    const double along = family.along_mm({p.x, p.y});
    double depth = thick / 2 - std::abs(family.across_mm({p.x, p.y}) - middle);
    depth = std::min({depth, along - rib.stretch.begin_mm, rib.stretch.end_mm - along});
    for (const Arch& arch : rib.arches) depth = std::min(depth, -arch.depth_mm(along, p.z));
    return std::min({depth, top - p.z, p.z - floor});
  };
  return part;
}

}  // namespace

ColumnCosts::ColumnCosts(const SolidVolume& volume, const AffineForm& kept, const Pulse& pulse)
    : frame_(volume.frame()) {
  const std::vector<CarvableBlock> blocks = carvable_blocks(volume, pulse);
  for (const CarvableBlock& block : blocks) {
    columns_ = std::max(columns_, block.origin[0] + CarvableBlock::size);
    rows_ = std::max(rows_, block.origin[1] + CarvableBlock::size);
  }
  in_order_.assign(static_cast<std::size_t>(columns_) * rows_, {});
  for (const CarvableBlock& block : blocks) {
    if (!pulse.goes_on(5)) return;
    for (int cell = 0; cell < CarvableBlock::cells; ++cell) {
      const double share = block.shares.empty() ? 1 : block.shares[cell];
      const int i = block.origin[0] + cell / 64, j = block.origin[1] + cell / 8 % 8, k = block.origin[2] + cell % 8;
      const Vec3 least = frame_.position_mm({i, j, k});
      const double l = kept(least + 0.5 * frame_.voxel_mm * Vec3{1, 1, 1});
      if (i < 0 || j < 0 || share == 0 || l >= 0) continue;
      Column& column = in_order_[static_cast<std::size_t>(j) * columns_ + i];
      const double above = least.z + frame_.voxel_mm;
      column.floor_mm = column.cost > 0 ? std::min(column.floor_mm, least.z) : least.z;
      column.top_mm = column.cost > 0 ? std::max(column.top_mm, above) : above;
      column.cost -= share * l * frame_.voxel_mm;
    }
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
    for (const Stretch& stretch : stretches(family, rib, cells, options)) {
      const double middle = family.first_mm + rib * family.pitch_mm;
      ribs.push_back(
          rib_part(family, middle, RibCutter(family, middle, stretch, cells, costs, options).cut(), options));
    }
  return ribs;
}

}  // namespace aplomb
