#include "aplomb/inserted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "aplomb/carve/moment_tree.h"
#include "aplomb/carve/plane_search.h"
#include "aplomb/core/pulse.h"
#include "aplomb/fdm/predict_print.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {
namespace {

constexpr int most_stacked = 10;
constexpr double bridged_ratio = 0.94;  // of the judge's limit
constexpr double steeper_deg = 2;       // than the judge's limit

struct Layers {
  double layer_mm = 0.2, first_mm = 0.2;
};

Layers layers_of(const StandOptions& options) {
  if (options.profile) return {options.profile->layer_mm, options.profile->first_layer_mm};
  return {options.judge.rules.layer_mm, options.judge.rules.layer_mm};
}

PocketRules pocket_rules(const StandOptions& options) {
  PocketRules rules;
  rules.layer_mm = layers_of(options).layer_mm;
  if (const auto span = detail::mildest_limit(options.judge.rules, "void.bridge"))
    rules.bridge_mm = bridged_ratio * *span;
  if (const auto slope = detail::mildest_limit(options.judge.rules, "void.slope"))
    rules.slope_deg = std::min(85.0, *slope + steeper_deg);
  return rules;
}

/// What of a solid is printed.
Result<Moments> printed(const SolidMesh& solid, const Moments& moments, const StandOptions& options, const Job& job) {
  if (!options.profile) return moments;
  const auto print = predict_print(printed_solid(solid), *options.profile, job);
  if (!print) return tl::unexpected(print.error());
  return print->all();
}

/// One run of with_inserts().
class Inserter {
 public:
  Inserter(const Input& input, const StandOptions& options) : input_(input), options_(options) {
    const PocketRules rules = pocket_rules(options);
    const double room = input.solid.box().size().z - 2 * options.wall_mm;
    for (std::uint32_t stock = 0; stock < options.inserts.size(); ++stock) {
      const auto& [insert, most] = options.inserts[stock];
      loads_.most.push_back(most);
      for (int stacked = 1; stacked <= std::min(most, most_stacked); ++stacked) {
        Pocket pocket = pocket_for(insert, stacked, rules);
        if (stacked > 1 && pocket.height_mm > room) break;
        pockets_.push_back(std::move(pocket));
        loads_.stocks.push_back(stock);
      }
      allowed_ += most;
    }
  }

  Result<Inserted> run(const Job& job) {
    auto joint = joint_problem(input_.solid.mesh(), options_.poses, kind_of(options_));
    if (!joint) return tl::unexpected(joint.error());
    joint_ = std::move(*joint);
    const auto solid = printed(input_.solid, input_.moments, options_, job.part(0, 0.1));
    if (!solid) return tl::unexpected(solid.error());
    const Layers layers = layers_of(options_);
    const auto fits = PocketFits::make(input_.solid, pockets_, {options_.wall_mm, layers.layer_mm, layers.first_mm},
                                       job.part(0.1, 0.4));
    if (!fits) return tl::unexpected(fits.error());
    loads_.density_g_per_cm3 = printed_density(options_);
    loads_.filled_ratio = std::min(1.0, solid->volume_mm3 / input_.moments.volume_mm3);
    loads_.kind = kind_of(options_);
    PlaceChooser chooser(*fits, fits->candidates(), joint_.problem, *solid, loads_);
    if (options_.aim == CarveAim::least) {
      auto alone = fewest(chooser, *fits, job.part(0.4, 0.8));
      if (!alone || *alone) return alone.map([](auto& made) { return std::move(*made); });
    }
    return beside_a_void(chooser, *fits, *solid, job.part(0.8, 1));
  }

 private:
  /// Nothing where inserts alone do not do.
  Result<std::optional<Inserted>> fewest(PlaceChooser& chooser, const PocketFits& fits, const Job& job) {
    int least = 1, beyond = allowed_ + 1;  // fewer than least are proved not to do
    while (least < beyond) {
      const int middle = (least + beyond) / 2;
      const auto bound = chooser.bound(middle, job.part(0, 0.1));
      if (!bound) return tl::unexpected(bound.error());
      if (*bound < joint_.required_t) least = middle + 1;
      else beyond = middle;
    }
    for (int count = least; count <= allowed_; ++count) {
      const double all = allowed_ - least + 1.0;
      const Job part = job.part(0.1 + 0.9 * (count - least) / all, 0.1 + 0.9 * (count - least + 1) / all);
      const auto choice = chooser.choose(count, part.part(0, 0.8));
      if (!choice) return tl::unexpected(choice.error());
      auto made = with(*choice, choice->bound_t, fits, part.part(0.8, 1));
      if (!made) return tl::unexpected(made.error());
      if (made->reaches) return std::optional(std::move(*made));
    }
    return std::optional<Inserted>();
  }

  /// As many as help, where they help a void most.
  Result<Inserted> beside_a_void(PlaceChooser& chooser, const PocketFits& fits, const Moments& solid, const Job& job) {
    const auto bound = chooser.bound(allowed_, job.part(0, 0.2));
    if (!bound) return tl::unexpected(bound.error());
    const auto plane = plane_of_void(chooser, solid, job.part(0.2, 0.6));
    if (!plane) return tl::unexpected(plane.error());
    const auto choice = chooser.choose_for(*plane, allowed_, job.part(0.6, 0.9));
    if (!choice) return tl::unexpected(choice.error());
    if (choice->places.empty()) {
      const auto fits_somewhere = chooser.any_fits(job.part(0.6, 0.9));
      if (!fits_somewhere) return tl::unexpected(fits_somewhere.error());
      if (!*fits_somewhere) return refusal(fits);
    }
    return with(*choice, *bound, fits, job.part(0.9, 1));
  }

  /// The plane that is best for a void and inserts together, were there room for both.
  Result<AffineForm> plane_of_void(const PlaceChooser& chooser, const Moments& solid, const Job& job) {
    const double voxel = std::min(2 * voxel_mm(options_, input_.solid.box()), options_.wall_mm / 2);
    const auto volume = voxelize(input_.solid, {options_.wall_mm, voxel, 0, options_.memory_bytes}, job.part(0, 0.7));
    if (!volume) return tl::unexpected(volume.error());
    const Pulse pulse(job, 0.7, "carve");
    const MomentTree tree(carvable_blocks(*volume, pulse), volume->frame());
    if (pulse.stopped()) return cancelled();
    const BestBody best_body = [&](const AffineForm& form) {
      return solid - loads_.filled_ratio * tree.not_positive_part(form) + chooser.relaxed_load(form, allowed_);
    };
    PlaneSearch search(joint_.problem, best_body, solid);
    const auto stable = search.most_stable(1e-5, job.part(0.7, 0.9));
    if (!stable) return tl::unexpected(stable.error());
    if (options_.aim != CarveAim::least || stable->t <= joint_.required_t) return stable->kept;
    const auto least = search.extreme_volume(VolumeAim::most, joint_.required_t, *stable, job.part(0.9, 1));
    if (!least) return tl::unexpected(least.error());
    return least->kept - AffineForm{1 / solid.volume_mm3, {}};  // an insert's worth is what it does for the rows
  }

  Result<Inserted> with(const PocketChoice& choice, double bound_t, const PocketFits& fits, const Job& job) {
    TriangleMesh inner;
    Inserted made{input_, figures_of(choice, bound_t, fits), std::numeric_limits<double>::infinity(), false};
    for (const PocketPlace& place : choice.places) {
      inner = joined(std::move(inner), rounded_to_float(pocket_mesh(pockets_[place.pocket], place.floor_mm)));
      made.wall_mm = std::min(made.wall_mm, fits.wall_mm(place, input_.solid.box().diagonal()));
      made.input.inserts.push_back(region_of(place));
    }
    if (!choice.places.empty()) {
      const auto solid = check_solid(joined(input_.solid.mesh(), reversed(inner)), job.part(0, 0.5));
      if (!solid) return tl::unexpected(solid.error());
      if (!solid->solid) return fail(ErrorCode::internal, "with pockets it is no solid: " + describe(solid->defects));
      made.input.solid = *solid->solid;
      made.input.moments = input_.moments - moments(inner);
    }
    const auto body = printed(made.input.solid, made.input.moments, options_, job.part(0.5, 1));
    if (!body) return tl::unexpected(body.error());
    const double t =
        loaded_t(joint_.problem, {*body, inserts_as_solid(made.input.inserts, options_)}, kind_of(options_));
    made.reaches = t >= joint_.required_t;
    made.figures.reached_rad = joint_.angle_rad(t);
    return made;
  }

  /// Steel and copper weigh what they do to 1 % (PRINTABILITY).
  Region region_of(const PocketPlace& place) const {
    const Pocket& pocket = pockets_[place.pocket];
    const double volume = pocket.stacked * volume_mm3(pocket.insert);
    const Vec3 centre = place.floor_mm + Vec3{0, 0, pocket.inserts_at_mm};
    return {{volume, volume * centre}, density_g_per_cm3(pocket.insert), 0.01};
  }

  InsertFigures figures_of(const PocketChoice& choice, double bound_t, const PocketFits& fits) const {
    InsertFigures figures;
    figures.allowed = allowed_;
    figures.bound_of = joint_.bound_of;
    figures.bound_rad = joint_.bound_rad(bound_t);
    figures.step_mm = fits.step_mm();
    figures.layer_mm = layers_of(options_).layer_mm;
    const double plate = input_.solid.box().min.z;
    for (const PocketPlace& place : choice.places) {
      const Pocket& pocket = pockets_[place.pocket];
      const auto height = [&](double z_mm) { return std::round((z_mm - plate) * 1e6) / 1e6; };  // 39.8 + 1e-14
      const double floor = height(place.floor_mm.z), open = height(place.floor_mm.z + pocket.open_mm);
      figures.pockets.push_back({pocket.insert.name, pocket.stacked, place.floor_mm + Vec3{0, 0, pocket.inserts_at_mm},
                                 open, floor, 2 * pocket.radius_mm, pocket.mass_g(),
                                 height(plate + open + figures.layer_mm)});
    }
    std::ranges::sort(figures.pockets, {}, &PocketFigures::pause_mm);
    return figures;
  }

  tl::unexpected<Error> refusal(const PocketFits& fits) const {
    const auto least = std::ranges::min_element(pockets_, {}, &Pocket::radius_mm);
    const double widest = fits.widest_mm(least->height_mm);
    const std::string most = widest > 0
                                 ? fmt::format("the widest pocket as high that fits is about {:.1f} mm across", widest)
                                 : "no pocket as high fits at all";
    return fail(
        ErrorCode::unusable_input,
        fmt::format("there is no place for a {}: its pocket is {:.1f} mm across and {:.1f} mm high, with {:g} mm "
                    "of material all round; {}",
                    least->insert.name, 2 * least->radius_mm, least->height_mm, options_.wall_mm, most));
  }

  const Input& input_;
  const StandOptions& options_;
  JointProblem joint_;
  std::vector<Pocket> pockets_;
  PocketLoads loads_;
  int allowed_ = 0;
};

}  // namespace

Moments inserts_as_solid(std::span<const Region> inserts, const StandOptions& options) {
  Moments sum;
  for (const Region& region : inserts) sum += region.density_g_per_cm3 / printed_density(options) * region.moments;
  return sum;
}

Result<Inserted> with_inserts(const Input& input, const StandOptions& options, StageClock& clock, const Job& job) {
  assert(!options.inserts.empty() && find_problem(options).empty());
  if (options.deform != Deform::never)
    return fail(ErrorCode::invalid_option,
                "inserts need --deform never: their pockets are cut into the model as it is");
  if (const Process process = options.judge.rules.process(); process != Process::fdm)
    return fail(ErrorCode::invalid_option,
                fmt::format("inserts are laid in while the print pauses, which process {} cannot; it must be fdm",
                            process_names[static_cast<std::size_t>(process)]));
  auto made = Inserter(input, options).run(job);
  clock.lap("inserts");
  return made;
}

}  // namespace aplomb
