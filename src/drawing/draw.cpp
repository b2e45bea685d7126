// SPDX-License-Identifier: LGPL-3.0-or-later
// A picture of bodies among walls.
#include <cellwalk/drawing/draw.h>
#include <cellwalk/internal/drawing/bodies.h>
#include <cellwalk/internal/io/atomic_file.h>

namespace cellwalk {

template <int D>
void draw(const Snapshot<D>& snapshot, const std::vector<const Body<D>*>& bodies,
          const std::vector<Contact<D>>& contacts, const std::string& file) {
  using namespace drawing;
  const double unit = diagonal_of(snapshot);
  const auto layer = [unit](int i) { return 1e-4 * unit * i; };
  Drawing drawing;
  const Scene_materials materials = add_materials(drawing, D == 2);
  std::size_t edges = 0, faces = 0;
  for (const Body<D>* body : bodies) edges += body->edges().size(), faces += body->faces().size();
  Body_share share(edges, faces);
  Round_shapes shapes = lines_of_walls(snapshot);
  shapes.balls += contacts.size();
  shapes.pieces += arrow_pieces * contacts.size();
  for (const Body<D>* body : bodies) count_shapes(*body, share, shapes);
  share.bound(shapes, drawing, D == 2);
  draw_walls(drawing, snapshot, materials.environment, share.shapes, unit);
  drawing.triangles.reserve(drawing.triangles.size() + share.triangles_of_shapes);
  Numbers_drawn numbers;
  for (const Body<D>* body : bodies)
    draw_body<D>(drawing, *body, body->positions(), materials, share, unit, layer(4), numbers);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (is_among(share.shapes, i))
      draw_contact<D>(drawing, contacts[i].point, contacts[i].normal, unit, layer(7), layer(8),
                      materials.contact);
  Picture_options how;
  if (D == 2) how.camera = {{0, 0, 1}, {0, 1, 0}, 0};
  io::write_file(file, encode_png(render(drawing, how)));
}

template void draw(const Snapshot<2>&, const std::vector<const Body<2>*>&, const std::vector<Contact<2>>&,
                   const std::string&);
template void draw(const Snapshot<3>&, const std::vector<const Body<3>*>&, const std::vector<Contact<3>>&,
                   const std::string&);

}  // namespace cellwalk
