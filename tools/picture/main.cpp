#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "aplomb/io/read_mesh.h"
#include "figure.h"
#include "picture.h"

namespace {

using namespace aplomb;
using namespace aplomb::picture;

struct Request {
  std::string model, after, out = "picture.png", up = "z";
  double contact_height_mm = 0.1;
  std::optional<double> azimuth_deg, heading_deg;
  double elevation_deg = 12;
  int size = 900;
  bool section = false, toppled = false, bare = false;
};

Vec3 direction(const std::string& name) {
  static const std::map<std::string, Vec3> known{{"x", {1, 0, 0}},   {"y", {0, 1, 0}},   {"z", {0, 0, 1}},
                                                 {"-x", {-1, 0, 0}}, {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}};
  return known.at(name);
}

Vec3 heading_of(const Request& request, const Figure& figure) {
  if (!request.heading_deg) return figure.standing.stability.heading;
  const double a = *request.heading_deg * std::numbers::pi / 180;
  return {std::cos(a), std::sin(a), 0};
}

View view_of(const Request& request, Vec3 heading) {
  View view;
  view.width = view.height = request.size;
  view.elevation_rad = request.elevation_deg * std::numbers::pi / 180;
  view.azimuth_rad = request.azimuth_deg ? *request.azimuth_deg * std::numbers::pi / 180 : azimuth_for_rad(heading);
  return view;
}

Result<Figure> read_figure(const std::string& path, const Request& request) {
  return read_mesh(path).and_then([&](const MeshFile& file) {
    TriangleMesh mesh;
    for (const MeshObject& object : file.objects) mesh = joined(std::move(mesh), object.mesh);
    return stood_up(std::move(mesh), {.up = direction(request.up), .contact_height_mm = request.contact_height_mm});
  });
}

Image one_figure(const Request& request, const Figure& figure) {
  const Vec3 heading = heading_of(request, figure);
  View view = view_of(request, heading);
  if (request.section) view.cut = section_along(figure.standing.stability.com_mm, heading, view.azimuth_rad);
  Subject subject = request.toppled ? as_it_comes_to_rest(figure) : drawn(figure);
  if (request.bare) {
    subject.com_mm.reset();
    subject.support_polygon_mm.clear();
  }
  return render(subject, view).image;
}

/// As it falls, what is inside, as it stands: at one scale, seen from one side.
Image before_and_after(const Request& request, const Figure& before, const Figure& after) {
  const Vec3 heading = heading_of(request, before);
  View view = view_of(request, heading);
  view.height = view.height * 5 / 6;
  const Subject fallen = as_it_comes_to_rest(before);
  const Subject standing = as_it_comes_to_rest(after);
  const Box3 upright = bounding_box(standing.mesh), lying = bounding_box(fallen.mesh);
  Vec3 size;
  for (int axis = 0; axis < 3; ++axis) size[axis] = std::max(upright.size()[axis], lying.size()[axis]);
  const auto frame = [&](const Box3& box) {
    const Vec3 low{0.5 * (box.min.x + box.max.x - size.x), 0.5 * (box.min.y + box.max.y - size.y), 0};
    return Box3{low, low + size};
  };
  view.frame_mm = frame(lying);
  const Image first = render(fallen, view).image;
  view.frame_mm = frame(upright);
  View opened = view;
  opened.cut = section_along(after.standing.stability.com_mm, heading, view.azimuth_rad);
  const Image second = render(standing, opened).image;
  const Image third = render(standing, view).image;
  return side_by_side(
      {{first, "solid: " + verdict(before)}, {second, "what was carved"}, {third, "carved: " + verdict(after)}});
}

Result<void> draw(const Request& request) {
  return read_figure(request.model, request).and_then([&](const Figure& figure) -> Result<void> {
    if (request.after.empty()) return write_png(request.out, one_figure(request, figure));
    return read_figure(request.after, request).and_then([&](const Figure& after) {
      return write_png(request.out, before_and_after(request, figure, after));
    });
  });
}

int exit_code(ErrorCode code) { return code == ErrorCode::invalid_option ? 1 : code == ErrorCode::internal ? 7 : 2; }

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app{"Draws a figure on the plate, or a figure before and after, as PNG"};
  app.add_option("model", request.model, "A mesh file")->required();
  app.add_option("after", request.after, "What became of it: three pictures side by side");
  app.add_option("-o,--out", request.out, "The PNG to write");
  app.add_option("--up", request.up, "Which way is up")->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}));
  app.add_option("--contact-height", request.contact_height_mm, "In mm above the lowest point: what touches the plate")
      ->check(CLI::PositiveNumber);
  app.add_option("--azimuth", request.azimuth_deg,
                 "Where the viewer stands, in degrees from +x; default: beside the fall");
  app.add_option("--elevation", request.elevation_deg, "Degrees above the plate")->check(CLI::Range(0.0, 89.0));
  app.add_option("--heading", request.heading_deg, "Direction of the section, in degrees; default: that of the fall");
  app.add_option("--size", request.size, "Pixels across one picture")->check(CLI::Range(16, 4000));
  app.add_flag("--section", request.section, "Cut open along the heading, through the centre of mass");
  app.add_flag("--toppled", request.toppled, "As it comes to rest");
  app.add_flag("--bare", request.bare, "Without centre of mass and support polygon");
  CLI11_PARSE(app, argc, argv);
  if (const auto drawn = draw(request); !drawn) {
    std::fprintf(stderr, "aplomb-picture: %s\n", drawn.error().message.c_str());
    return exit_code(drawn.error().code);
  }
  return 0;
}
