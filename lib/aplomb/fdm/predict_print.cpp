#include "aplomb/fdm/predict_print.h"

#include <utility>

#include "aplomb/fdm/layered_print.h"

namespace aplomb {

std::vector<Region> PredictedPrint::body(double density_g_per_cm3) const {
  std::vector<Region> body;
  for (const auto& [moments, error_ratio] :
       {std::pair{walls, 0.02}, std::pair{solid_infill, 0.02}, std::pair{sparse_infill, 0.15}})
    if (moments.volume_mm3 > 0) body.push_back({moments, density_g_per_cm3, error_ratio});
  return body;
}

Result<PredictedPrint> predict_print(const PrintedSolid& printed, const PrintProfile& profile, const Job& job) {
  const auto layered = LayeredPrint::make(printed, profile, job.part(0, 0.7));
  if (!layered) return tl::unexpected(layered.error());
  return layered->fill({}, job.part(0.7, 1));
}

}  // namespace aplomb
