// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Settings to lines of text.
#include "engine/store/run_identity.h"

#include <array>
#include <charconv>
#include <optional>

#include "io/file/errors.h"

namespace mw::engine {
namespace {

/// The shortest text that reads back as the same number.
std::string number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string number(const std::optional<double>& value) {
  return value ? number(*value) : "none";
}

std::string triple(const std::array<double, 3>& v) {
  return number(v[0]) + "," + number(v[1]) + "," + number(v[2]);
}

const char* start_name(StartMesh start) {
  return start == StartMesh::kCoarse ? "coarse" : start == StartMesh::kOctree ? "octree" : "dense";
}

const char* optimizer_name(Optimizer optimizer) {
  return optimizer == Optimizer::kLocal    ? "local"
         : optimizer == Optimizer::kTetgen ? "tetgen"
                                           : "none";
}

/// Nothing without sizes.
std::string sizes_text(const SizeSettings& sizes) {
  if (sizes.labels.empty()) return sizes.inner_vertices ? "inner-vertices = all\n" : "";
  std::string out = "size = ";
  for (const LabelSize& s : sizes.labels) {
    out += io::text(&s == sizes.labels.data() ? "" : ",", s.label, "=", number(s.longest_edge));
  }
  return io::text(out, "\ngradation = ", number(sizes.gradation), "\n",
                  sizes.inner_vertices ? "inner-vertices = listed\n" : "");
}

}  // namespace

std::string identity_text(const io::VolumeInfo& volume, const MeshSettings& s) {
  const Index3 shape = volume.shape;
  return io::text("shape = ", shape.x, ",", shape.y, ",", shape.z, "\n",  //
                  "type = ", io::name(volume.type), "\n",                 //
                  "spacing = ", triple(volume.space.spacing), "\n",       //
                  "axes = ", triple(volume.space.axes[0]), " ", triple(volume.space.axes[1]), " ",
                  triple(volume.space.axes[2]), "\n",                                 //
                  "origin = ", triple(volume.space.origin), "\n",                     //
                  "window = ", s.window, "\n",                                        //
                  "marches = ", s.marches, "\n",                                      //
                  "order = ", s.order == Order::kColour ? "colour" : "raster", "\n",  //
                  "start = ", start_name(s.start), "\n",                              //
                  "topology = ", s.topology == KeptTopology::kInterfaces ? "interfaces" : "labels",
                  "\n",                                                                    //
                  "edge-variance = ", number(s.edge_variance), "\n",                       //
                  "quality-floor = ", number(s.quality_floor), "\n",                       //
                  "max-distance = ", number(s.max_distance), "\n",                         //
                  "target-reduction = ", number(s.target_reduction), "\n",                 //
                  "surface = ", s.surface == Surface::kSmooth ? "smooth" : "voxel", "\n",  //
                  "optimizer = ", optimizer_name(s.optimizer), "\n",                       //
                  "odt-iterations = ", s.odt_iterations, "\n", sizes_text(s.sizes));
}

}  // namespace mw::engine
