#include "page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <numbers>

#include "aplomb/report/text.h"
#include "comparison.h"
#include "diagrams.h"
#include "stress_picture.h"

namespace aplomb::page {
namespace {

using Verdict = CheckResult::Verdict;

constexpr int picture_size = 420;

constexpr const char* style = R"(
:root{color-scheme:light dark;--ink:#1c1b19;--paper:#fbfaf8;--soft:#6b675f;--line:#d9d5cc;--good:#176b3a;--bad:#a3211b;--mild:#7a5300;--blue:#2a5db0}
@media (prefers-color-scheme:dark){:root{--ink:#eceae5;--paper:#1b1a18;--soft:#a9a49a;--line:#3c3a36;--good:#6fd097;--bad:#ff8d84;--mild:#e9bd5c;--blue:#8ab2f5}}
body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:64rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.6rem;margin:0 0 .2rem}h2{font-size:1.15rem;margin:2rem 0 .6rem}p.model{color:var(--soft);margin:0}
img{width:100%;height:auto;border-radius:.4rem}figure{margin:1rem 0}figcaption{color:var(--soft);font-size:.9rem}
.diagrams{display:grid;grid-template-columns:repeat(auto-fit,minmax(16rem,1fr));gap:1.5rem}.diagrams svg{width:100%;max-height:20rem}
table{border-collapse:collapse;width:100%}th,td{text-align:left;padding:.3rem .6rem;border-bottom:1px solid var(--line);vertical-align:top}td.n{text-align:right;white-space:nowrap}
.passed{color:var(--good)}.failed{color:var(--bad);font-weight:600}.warned{color:var(--mild);font-weight:600}.info,.waived,.not_judged{color:var(--soft)}
.support{fill:var(--blue);fill-opacity:.15;stroke:var(--blue);vector-effect:non-scaling-stroke;stroke-width:1.5}.region{fill:var(--good);fill-opacity:.2;stroke:var(--good);stroke-dasharray:4 3;vector-effect:non-scaling-stroke}
.weak{stroke:var(--bad);stroke-width:3;vector-effect:non-scaling-stroke}.com{fill:var(--ink)}.ring{fill:none;stroke:var(--line)}.tip{fill:var(--blue);fill-opacity:.2;stroke:var(--blue);stroke-width:1.5}.asked{fill:none;stroke:var(--good);stroke-width:1.5;stroke-dasharray:5 3}
svg text{font-size:8px;fill:var(--soft)}pre{overflow-x:auto;background:color-mix(in srgb,var(--ink) 5%,transparent);padding:.8rem;border-radius:.4rem;font-size:.85rem})";

const char* word_of(Verdict verdict) {
  constexpr std::array words{"passed", "for information", "warning", "FAILS", "waived", "not judged"};
  return words[static_cast<std::size_t>(verdict)];
}

const char* class_of(Verdict verdict) {
  constexpr std::array names{"passed", "info", "warned", "failed", "waived", "not_judged"};
  return names[static_cast<std::size_t>(verdict)];
}

const CheckRule* rule_of(const std::string& id) {
  const auto found = std::ranges::find(check_rules(), std::string_view(id), &CheckRule::id);
  return found == check_rules().end() ? nullptr : &*found;
}

std::string measure(double value, const CheckRule& rule) {
  return fmt::format("{:.4g}{}{}", value == 0 ? 0.0 : value, rule.unit.empty() ? "" : " ", rule.unit);
}

std::string headline(const PageContent& content) {
  std::string text;
  if (content.report) text = verdict(*content.report);
  if (content.judgement) {
    const bool passes = content.judgement->passes();
    const std::string_view process = process_names[static_cast<std::size_t>(content.judgement->process)];
    text += fmt::format("{}{} ({})", text.empty() ? "" : ". ", passes ? "Prints" : "Will not print as it is", process);
  }
  return text;
}

/// The places of findings, numbered to be found in the pictures.
struct Marks {
  std::vector<picture::Mark> marks;
  std::vector<std::string> of_finding;  ///< the number of its mark, or nothing
};

/// Findings near one another share a mark, and more than a dozen would hide the model.
Marks marks_of(const PageContent& content) {
  constexpr std::size_t most = 12;
  Marks found;
  if (!content.judgement) return found;
  const double near_mm = 0.04 * bounding_box(content.after ? *content.after : *content.before).diagonal();
  for (const Finding& f : content.judgement->findings) {
    std::string& number = found.of_finding.emplace_back();
    if (f.box_mm.empty() || f.severity == Severity::info) continue;
    auto at = std::ranges::find_if(found.marks, [&](const auto& mark) { return norm(mark.at_mm - f.at_mm) < near_mm; });
    if (at == found.marks.end()) {
      if (found.marks.size() == most) continue;
      at = found.marks.insert(at, {f.at_mm, fmt::format("{}", found.marks.size() + 1)});
    }
    number = at->text;
  }
  return found;
}

Result<std::string> figure_of(const picture::Image& image, const Job& job, const std::string& about,
                              const std::string& caption = "") {
  const auto png = picture::encode_png(image, job);
  if (!png) return tl::unexpected(png.error());
  return fmt::format("<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\">{}</figure>\n", about, base64(*png),
                     caption);
}

Result<std::string> stresses(const PageContent& content, const Job& job) {
  if (!content.judgement || !content.judgement->stress) return "";
  const StressField& field = *content.judgement->stress;
  const auto image = picture::stress_picture(field, picture_size, job);
  if (!image) return tl::unexpected(image.error());
  return figure_of(*image, job, "The model from the front and from behind, darker where it is stressed more")
      .map([&](const std::string& figure) {
        return fmt::format(
            "<h2>Where it is stressed</h2>\n{}<p>Under its own weight and a push of 10 N at its top, "
            "in each place from whichever side is worst. 1 mm³ of what is judged exceeds {:.3g} MPa; "
            "close to the plate, where it is held fast, and to the top nothing is judged.</p>\n",
            figure, field.measured_mpa);
      });
}

Result<std::string> pictures(const PageContent& content, const std::vector<picture::Mark>& marks, const Job& job) {
  const auto image = content.before && content.after
                         ? picture::before_and_after(*content.before, *content.after, content.poses, picture_size,
                                                     marks, job, content.inserts)
                         : picture::as_it_is(content.after ? *content.after : *content.before, content.poses,
                                             picture_size, marks, job);
  if (!image) return tl::unexpected(image.error());
  return figure_of(*image, job, "The model, cut open and whole, with its centre of mass and support polygon",
                   marks.empty() ? "" : "<figcaption>Rings: places of what is listed below, by number.</figcaption>");
}

std::string diagrams(const PageContent& content) {
  if (!content.standing || content.standing->support.degenerate()) return "";
  const double asked_deg = content.required_tip_rad * 180 / std::numbers::pi;
  return fmt::format(
      "<h2>How it stands</h2>\n<div class=\"diagrams\">\n"
      "<figure>{}<figcaption>From above: what it stands on, its centre of mass, the edge it tips over (thick), and "
      "where the centre of mass would have to be to stand to {:.1f}° (dashed).</figcaption></figure>\n"
      "<figure>{}<figcaption>Tip angle by direction; dashed: {:.1f}° asked for.</figcaption></figure>\n</div>\n",
      support_svg(*content.standing, content.required_tip_rad), asked_deg,
      directions_svg(*content.standing, content.required_tip_rad), asked_deg);
}

std::string findings(const Judgement& judgement, const Marks& marks) {
  if (judgement.findings.empty()) return "";
  std::string rows;
  for (std::size_t n = 0; n < judgement.findings.size(); ++n) {
    const Finding& f = judgement.findings[n];
    const auto place = f.box_mm.empty() ? std::string("whole model")
                                        : fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", f.at_mm.x, f.at_mm.y, f.at_mm.z);
    const std::string_view as_it_came = f.in_input ? "; the model as it came has it, too" : "";
    rows += fmt::format("<tr><td class=\"n\">{}</td><td>{}</td><td>{}{}</td><td>{}</td><td>{}</td></tr>\n",
                        marks.of_finding[n], escaped(f.id), escaped(f.text), as_it_came, place, escaped(f.remedy));
  }
  return "<h2>What is in the "
         "way</h2>\n<table><thead><tr><th>mark</th><th>check</th><th>found</th><th>where</th><th>what "
         "helps</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string checks(const Judgement& judgement) {
  std::string rows;
  for (const CheckResult& c : judgement.checks) {
    const CheckRule* rule = rule_of(c.id);
    if (!rule) continue;
    rows += fmt::format(
        "<tr><td>{}</td><td>{}{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"{}\">{}</td></tr>\n",
        escaped(c.id), escaped(std::string(rule->what)), c.why.empty() ? "" : ": " + escaped(c.why),
        c.has_measure ? measure(c.measured, *rule) : "",
        c.has_measure ? fmt::format("{} {}", rule->is_least ? "≥" : "≤", measure(c.threshold, *rule)) : "",
        class_of(c.verdict), word_of(c.verdict));
  }
  return "<h2>Checks</h2>\n<table><thead><tr><th>check</th><th>what is measured</th><th>measured</th><th>limit</th>"
         "<th>verdict</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

}  // namespace

Result<std::string> html_page(const PageContent& content, const Job& job) {
  assert(content.before || content.after);
  const Marks marks = marks_of(content);
  const auto shown = pictures(content, marks.marks, job.part(0, 0.6));
  if (!shown) return tl::unexpected(shown.error());
  const auto stressed = stresses(content, job.part(0.6, 1));
  if (!stressed) return tl::unexpected(stressed.error());
  const std::string title = escaped(content.title), said = escaped(headline(content));
  std::string body =
      fmt::format("<h1>{}</h1>\n<p class=\"model\">{}</p>\n{}{}", said, title, *shown, diagrams(content));
  if (content.judgement) body += findings(*content.judgement, marks) + *stressed + checks(*content.judgement);
  if (content.report)
    body += fmt::format("<h2>Before and after, in numbers</h2>\n<pre>{}</pre>\n", escaped(to_text(*content.report)));
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "img-src "
      "data:; style-src 'unsafe-inline'\">\n<title>{}: "
      "{}</title>\n<style>{}</style></head>\n<body>\n{}</body></html>\n",
      title, said, style, body);
}

std::string base64(const std::vector<std::byte>& bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * ((bytes.size() + 2) / 3));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<unsigned>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : letters[group >> (18 - 6 * k) & 63U];
  }
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

}  // namespace aplomb::page
