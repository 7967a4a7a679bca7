#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/report/report.h"

/// A run's report as one HTML page for people: the verdict first, pictures, diagrams, checks, before and after. It
/// holds everything it needs, opens without a network, and is readable in light and dark and without colours.
namespace aplomb::page {

struct PageContent {
  std::string title;                     ///< the model's name
  const TriangleMesh* before = nullptr;  ///< what came; none: only `after` is shown
  const TriangleMesh* after = nullptr;   ///< what was judged or written; none: only `before` is shown
  std::vector<Pose> poses{};             ///< how it is shown; one or more
  std::optional<Report> report{};        ///< of check and stand
  std::optional<Judgement> judgement{};  ///< of validate and stand
  std::optional<Standing> standing{};    ///< for the diagrams; none: it does not stand
  double required_tip_rad = 0;
  Moments inserts{};  ///< in voids of `after`, as so much of its material
};

/// \pre before or after is given.
/// \return what before_and_after() returns. \par Cost  pictures: 3 s of CPU; the page takes 0.3 to 1 MB.
Result<std::string> html_page(const PageContent& content, const Job& job = {});

/// RFC 4648.
std::string base64(const std::vector<std::byte>& bytes);

/// With & < > " as entities.
std::string escaped(const std::string& text);

}  // namespace aplomb::page
