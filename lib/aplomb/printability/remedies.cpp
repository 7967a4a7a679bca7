#include "aplomb/printability/remedies.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace aplomb {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 24> remedies{{
    {"mesh.manifold", "repair the mesh: `aplomb stand` does, and says what it decided"},
    {"mesh.orientation",
     "turn the shells round that are wound the wrong way: slicers fill a void that is wound like its outside"},
    {"mesh.intersection", "unite the parts that cross, or repair the mesh"},
    {"mesh.degenerate", "merge or remove the triangles that have no area"},
    {"mesh.roundtrip", "write another format; coordinates are rounded to float32"},
    {"wall.void_outer", "carve with a thicker --wall"},
    {"wall.void_void", "carve with a thicker --wall, or join the voids"},
    {"wall.thin", "make it thicker, scale the model up, or print finer; it was so before anything was carved"},
    {"void.bridge", "shape the void so that its ceiling closes towards walls, or print it another way up"},
    {"void.slope", "shape the void with a steeper ceiling, or print it another way up"},
    {"void.island", "no support can be taken out of a void: shape it so that nothing hangs into it"},
    {"void.closed", "cut escape holes through the wall, underneath where nobody sees them"},
    {"void.holes", "cut more, or wider, escape holes"},
    {"void.hole_place", "put one hole at the void's lowest point and a vent at its highest, far apart"},
    {"void.cup", "cut a vent at the top of the cup, or turn the model"},
    {"void.base", "carve with a thicker --wall, or start the void higher"},
    {"stand.nominal", "carve it: `aplomb stand`; or give it a wider base"},
    {"stand.robust", "ask `aplomb stand --robust`, or for a larger --tip"},
    {"stand.trapped", "cut escape holes, so that nothing stays in the voids"},
    {"mass.gained",
     "print with more infill, or leave the void out: skins round it weigh more than the infill it saves"},
    {"strength.ankle", "make the weakest section thicker, or print it in another material or direction"},
    {"strength.fem", "make it thicker there or round a sharp inner edge, or print it in another material or direction"},
    {"bed.contact", "print with a brim or raft"},
    {"print.stands", "print with a brim, raft or supports, or lay it another way"},
}};

}  // namespace

std::string_view remedy_of(std::string_view id) {
  const auto* found = std::ranges::find(remedies, id, &std::pair<std::string_view, std::string_view>::first);
  assert(found != remedies.end());
  return found->second;
}

}  // namespace aplomb
