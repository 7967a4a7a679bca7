#include "aplomb/mesh/detail/corner_table.h"

#include <cassert>

namespace aplomb::detail {

CornerTable::CornerTable(const TriangleMesh& mesh, const Pulse& pulse)
    : vertices_(3 * mesh.triangles.size()),
      twins_(vertices_.size(), none),
      leaving_(mesh.vertices.size(), none),
      valences_(mesh.vertices.size(), 0),
      marks_(mesh.vertices.size(), 0) {
  for (Corner c = 0; c < vertices_.size(); ++c) {
    const std::uint32_t v = vertices_[c] = vertex_at(mesh, c);
    leaving_[v] = c;
    ++valences_[v];
  }
  const auto join = [&](std::uint32_t, std::uint32_t, std::span<const Corner> corners) {
    assert(corners.size() == 2);
    glue(corners[0], corners[1]);
  };
  EdgeTable(mesh, pulse).for_each(join, pulse);
}

bool CornerTable::may_collapse(Corner c) {
  const std::uint32_t u = vertex(c), v = head(c);
  const Corner after = turned(c), before = next_corner(twin(c));
  if (valences_[head(after)] < 4 || valences_[head(before)] < 4 || valences_[u] + valences_[v] < 7) return false;
  ++question_;
  for (Corner e = after; e != c; e = turned(e)) marks_[head(e)] = question_;
  int shared = 0;
  const Corner back = twin(c);
  for (Corner e = turned(back); e != back; e = turned(e)) shared += marks_[head(e)] == question_;
  return shared == 2;
}

void CornerTable::collapse(Corner c) {
  const std::uint32_t u = vertex(c), v = head(c);
  const Corner back = twin(c);
  const Corner left_in = twins_[next_corner(c)], left_out = twins_[previous(c)];          // at the apex of c's triangle
  const Corner right_in = twins_[next_corner(back)], right_out = twins_[previous(back)];  // and of its twin's
  const std::uint32_t left = vertices_[previous(c)], right = vertices_[previous(back)];
  for (Corner e = turned(c); e != c; e = turned(e)) vertices_[e] = v;
  glue(left_in, left_out);
  glue(right_in, right_out);
  leaving_[u] = none;
  leaving_[v] = left_out;
  leaving_[left] = left_in;
  leaving_[right] = right_in;
  valences_[v] = valences_[u] + valences_[v] - 4;
  --valences_[left];
  --valences_[right];
  valences_[u] = 0;
  for (const Corner start : {c - c % 3, back - back % 3})
    for (Corner e = start; e < start + 3; ++e) vertices_[e] = none;
}

}  // namespace aplomb::detail
