// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A wrong mesh is not believed because its file says that little was promised of it: each key of
// the record weakened, each of thirty damages.
#include <cmath>

#include "engine/job/mesh_job.h"
#include "engine/job/verify_job.h"
#include "io/mesh/mesh_data.h"
#include "kernels/core/error.h"
#include "tests/engine/memory_run.h"
#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

using io::MeshData;
using io::Position;
using namespace test;

constexpr double kEdge = 20;

/// Two balls of different sizes, away from the middle and from each other.
audit::test::SmallVolume two_balls() {
  const auto edge = static_cast<std::int64_t>(kEdge);
  return audit::test::volume_from({edge, edge, edge}, 3, [](auto x, auto y, auto z) {
    const auto square = [](auto a, auto b) { return (a - b) * (a - b); };
    if (square(x, 6) + square(y, 8) + square(z, 5) < 22) return 1;
    return square(x, 12) + square(y, 13) + square(z, 14) < 33 ? 2 : 0;
  });
}

double volume6(const MeshData& mesh, const io::TetRows& tet) {
  std::array<Position, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      e[i][k] = mesh.vertices[tet[i + 1]][k] - mesh.vertices[tet[0]][k];
    }
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
         e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// Every tet is as positive as before, and still in the mirror.
void mirror(MeshData& mesh, std::array<bool, 3> axes) {
  for (Position& p : mesh.vertices) {
    for (std::size_t k = 0; k < 3; ++k) p[k] = axes[k] ? kEdge - p[k] : p[k];
  }
  for (io::TetRows& tet : mesh.tets) {
    if (volume6(mesh, tet) < 0) std::swap(tet[0], tet[1]);
  }
}

void relabel(MeshData& mesh, Label from, Label to) {
  for (RawLabel& label : mesh.labels) {
    if (label == raw_label(from)) label = raw_label(to);
  }
}

template <class Goes>
void remove_tets(MeshData& mesh, Goes goes) {
  MeshData kept = mesh;
  kept.tets.clear();
  kept.labels.clear();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (goes(t)) continue;
    kept.tets.push_back(mesh.tets[t]);
    kept.labels.push_back(mesh.labels[t]);
  }
  mesh = kept;
}

/// Moves a vertex nearly into the opposite side of one of its tets, where all tets stay positive.
void make_sliver(MeshData& mesh) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const std::uint64_t v : mesh.tets[t]) {
      const Position before = mesh.vertices[v];
      Position& p = mesh.vertices[v];
      const bool on_box =
          std::any_of(p.begin(), p.end(), [](double x) { return x == 0 || x == kEdge; });
      Position side{};
      for (const std::uint64_t other : mesh.tets[t]) {
        for (std::size_t k = 0; k < 3 && other != v; ++k) side[k] += mesh.vertices[other][k] / 3;
      }
      for (std::size_t k = 0; k < 3; ++k) p[k] = side[k] + 1e-6 * (p[k] - side[k]);
      bool one_label = true, positive = true;
      for (std::size_t u = 0; u < mesh.tets.size(); ++u) {
        const auto& tet = mesh.tets[u];
        if (std::find(tet.begin(), tet.end(), v) == tet.end()) continue;
        one_label = one_label && mesh.labels[u] == mesh.labels[t];
        positive = positive && volume6(mesh, tet) > 0;
      }
      if (!on_box && one_label && positive) return;
      p = before;
    }
  }
  FAIL() << "no tet can be made a sliver";
}

struct Damage {
  const char* name;
  std::function<void(MeshData&)> change;
};

const std::vector<Damage>& mirrors() {
  static const std::vector<Damage> all{{"mirror x",
                                        [](MeshData& m) {
                                          mirror(m, {true, false, false});
                                        }},
                                       {"mirror y",
                                        [](MeshData& m) {
                                          mirror(m, {false, true, false});
                                        }},
                                       {"mirror z",
                                        [](MeshData& m) {
                                          mirror(m, {false, false, true});
                                        }},
                                       {"turn about z",
                                        [](MeshData& m) {
                                          mirror(m, {true, true, false});
                                        }},
                                       {"turn about x",
                                        [](MeshData& m) {
                                          mirror(m, {false, true, true});
                                        }},
                                       {"mirror all",
                                        [](MeshData& m) {
                                          mirror(m, {true, true, true});
                                        }},
                                       {"swap axes",
                                        [](MeshData& m) {
                                          for (Position& p : m.vertices) std::swap(p[0], p[2]);
                                          mirror(m, {false, false, false});
                                        }},
                                       {"mirror, tets turned over", [](MeshData& m) {
                                          for (Position& p : m.vertices) p[0] = kEdge - p[0];
                                        }}};
  return all;
}

const std::vector<Damage>& others() {
  static const std::vector<Damage> all{
      {"swap labels",
       [](MeshData& m) {
         relabel(m, 1, 7);
         relabel(m, 2, 1);
         relabel(m, 7, 2);
       }},
      {"lose a label to another", [](MeshData& m) { relabel(m, 1, 0); }},
      {"one label",
       [](MeshData& m) {
         relabel(m, 1, 0);
         relabel(m, 2, 0);
       }},
      {"a label that is not in the volume", [](MeshData& m) { m.labels[5] = 12345; }},
      {"a strange label for a whole one", [](MeshData& m) { relabel(m, 2, 9); }},
      {"a tet of another label",
       [](MeshData& m) {
         const auto at = std::find(m.labels.begin(), m.labels.end(), raw_label(2));
         *at = raw_label(1);
       }},
      {"shift",
       [](MeshData& m) {
         for (Position& p : m.vertices) p[1] += 1;
       }},
      {"scale",
       [](MeshData& m) {
         for (Position& p : m.vertices) p[2] *= 1.01;
       }},
      {"squeeze",
       [](MeshData& m) {
         for (Position& p : m.vertices) p[0] = p[0] * p[0] / kEdge;
       }},
      {"a tet less", [](MeshData& m) { remove_tets(m, [](std::size_t t) { return t == 17; }); }},
      {"half of the tets",
       [](MeshData& m) { remove_tets(m, [](std::size_t t) { return t % 2 == 0; }); }},
      {"a label less",
       [](MeshData& m) {
         const MeshData whole = m;
         remove_tets(m, [&](std::size_t t) { return whole.labels[t] == raw_label(1); });
       }},
      {"no tets", [](MeshData& m) { remove_tets(m, [](std::size_t) { return true; }); }},
      {"a tet twice",
       [](MeshData& m) {
         m.tets.push_back(m.tets[3]);
         m.labels.push_back(m.labels[3]);
       }},
      {"a tet turned over", [](MeshData& m) { std::swap(m.tets[8][0], m.tets[8][1]); }},
      {"all tets turned over",
       [](MeshData& m) {
         for (io::TetRows& tet : m.tets) std::swap(tet[0], tet[1]);
       }},
      {"another corner", [](MeshData& m) { m.tets[9][1] = m.tets[30][2]; }},
      {"a corner that is not there", [](MeshData& m) { m.tets[9][1] = m.vertices.size(); }},
      {"a vertex of no tet",
       [](MeshData& m) {
         m.vertices.push_back({3.25, 4.5, 5.125});
       }},
      {"two vertices in one place", [](MeshData& m) { m.vertices[4] = m.vertices[5]; }},
      {"no number",
       [](MeshData& m) { m.vertices[6][1] = std::numeric_limits<double>::quiet_NaN(); }},
      {"sliver", make_sliver}};
  return all;
}

/// What verify makes of a mesh.
enum class Outcome { kRefused, kFails, kTold, kBelieved };

class RecordedPromises : public testing::Test {
 protected:
  RecordedPromises() : volume_(small_, {}) {
    io::MeshDataSink sink;
    MeshJob job{.folder = folder_.path()};
    job.run.threads = 1;
    job.run.store.memory = kMemory;
    static_cast<void>(mesh(volume_, job, std::array<io::MeshSink*, 1>{&sink}));
    mesh_ = sink.mesh();
  }

  /// record: as in a file.
  [[nodiscard]] Outcome outcome(const Damage& damage, const std::string& record) const {
    MeshData mesh = mesh_;
    damage.change(mesh);
    const VerifyJob job{
        .volume = volume_, .steps = {}, .threads = 1, .memory = kMemory, .folder = folder_.path()};
    try {
      mesh.record = io::parse_record(record, "mesh");
      const report::Verdict verdict =
          verify(job, [&](io::MeshSink& sink) { io::write_mesh(mesh, sink); });
      if (!verdict.audit.passed()) return Outcome::kFails;
      return verdict.bounds.told.empty() ? Outcome::kBelieved : Outcome::kTold;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
      return Outcome::kRefused;
    }
  }

  [[nodiscard]] static std::string promises(const std::string& distance, const std::string& floor,
                                            const std::string& topology = "labels",
                                            const std::string& surface = "smooth",
                                            const std::string& more = "") {
    return R"("promises": {"max_distance": )" + distance + R"(, "quality_floor": )" + floor +
           R"(, "topology": ")" + topology + R"(", "surface": ")" + surface + "\"" + more + "}";
  }

  /// Every key as weak as a run can make it, or as none can.
  [[nodiscard]] static std::vector<std::string> weak_records() {
    const std::string usual = promises("1.5", "0.2");
    std::vector<std::string> all;
    for (const char* bound : {"null", "16", "2", "1e300", "17", "-1", "0", "\"none\""}) {
      all.push_back(promises(bound, "0.2"));
      all.push_back(promises(bound, "0", "labels", "voxel", R"(, "optimizer": "none")"));
    }
    for (const char* floor : {"0", "1e-9", "0.1", "-1", "1", "null"}) {
      all.push_back(promises("1.5", floor));
    }
    for (const char* halvings : {"1", "2", "3", "-1", "0.5"}) {
      const std::string more = std::string(R"(, "halvings": )") + halvings;
      all.push_back(promises("1.5", "0.2", "labels", "smooth", more));
    }
    for (const char* topology : {"interfaces", "none", ""}) {
      all.push_back(promises("1.5", "0.2", topology));
    }
    for (const char* surface : {"voxel", "none"}) {
      all.push_back(promises("1.5", "0.2", "labels", surface));
    }
    for (const char* optimizer : {"none", "tetgen"}) {
      all.push_back(promises("1.5", "0.2", "labels", "smooth",
                             std::string(R"(, "optimizer": ")") + optimizer + "\""));
    }
    for (const Label label : {0U, 1U, 2U}) {
      for (const char* key : {"only_labels", "without_labels"}) {
        all.push_back(usual + ", \"" + key + "\": [" + std::to_string(raw_label(label)) + "]");
      }
    }
    all.push_back(usual + R"(, "without_labels": [)" + std::to_string(raw_label(0)) + ", " +
                  std::to_string(raw_label(1)) + ", " + std::to_string(raw_label(2)) + "]");
    all.emplace_back(R"("promises": {})");
    for (std::string& record : all) record = "{" + record + "}";
    all.emplace_back("");
    return all;
  }

  static constexpr std::uint64_t kMemory = std::uint64_t{1} << 30U;

  const ::mw::test::TempFolder folder_;
  const audit::test::SmallVolume small_ = two_balls();
  const MemoryVolume volume_;
  MeshData mesh_;
};

TEST_F(RecordedPromises, OfTheRunFailEveryDamage) {
  const std::string record = io::record_text(mesh_.record);
  EXPECT_EQ(outcome({"", [](MeshData&) {}}, record), Outcome::kBelieved);
  EXPECT_EQ(mirrors().size() + others().size(), 30U);
  for (const auto* damages : {&mirrors(), &others()}) {
    for (const Damage& damage : *damages) {
      EXPECT_EQ(outcome(damage, record), Outcome::kFails) << damage.name;
    }
  }
}

TEST_F(RecordedPromises, AreNotBelievedWhenTheyAreWeak) {
  int told = 0, refused = 0;
  for (const std::string& record : weak_records()) {
    SCOPED_TRACE(record);
    for (const Damage& damage : mirrors()) {
      const Outcome found = outcome(damage, record);
      EXPECT_TRUE(found == Outcome::kFails || found == Outcome::kRefused) << damage.name;
    }
    for (const Damage& damage : others()) {
      const Outcome found = outcome(damage, record);
      EXPECT_NE(found, Outcome::kBelieved) << damage.name;
      told += found == Outcome::kTold ? 1 : 0;
      refused += found == Outcome::kRefused ? 1 : 0;
    }
  }
  EXPECT_GT(told, 2);
  EXPECT_GT(refused, 100);
}

/// What is alike everywhere has its centre in the middle, in the mirror, too.  Without a bound of
/// distances nothing but the whole tells one from the other.
TEST_F(RecordedPromises, TellAFoamFromItsMirror) {
  const auto edge = static_cast<std::int64_t>(kEdge);
  const audit::test::SmallVolume foam =
      audit::test::volume_from({edge, edge, edge}, 2, [](auto x, auto y, auto z) {
        const auto wave = [](double at) { return std::sin(0.9 * at); };
        const double dx = static_cast<double>(x), dy = static_cast<double>(y),
                     dz = static_cast<double>(z);
        return wave(dx + 0.3 * dy) + wave(dy) + wave(dz + 0.4 * dx) > 0 ? 1 : 0;
      });
  const MemoryVolume volume(foam, {});
  MeshJob job{.folder = folder_.path()};
  job.run.threads = 1;
  job.run.store.memory = kMemory;
  job.settings.surface = Surface::kVoxel;
  job.settings.max_distance.reset();
  io::MeshDataSink sink;
  static_cast<void>(mesh(volume, job, std::array<io::MeshSink*, 1>{&sink}));
  const VerifyJob verified{
      .volume = volume, .steps = {}, .threads = 1, .memory = kMemory, .folder = folder_.path()};
  const auto passes = [&](const Damage& damage) {
    MeshData damaged = sink.mesh();
    damage.change(damaged);
    return verify(verified, [&](io::MeshSink& out) { io::write_mesh(damaged, out); })
        .audit.passed();
  };
  EXPECT_TRUE(passes({"", [](MeshData&) {}}));
  for (const Damage& damage : mirrors()) EXPECT_FALSE(passes(damage)) << damage.name;
  EXPECT_FALSE(passes({"swap labels", [](MeshData& m) {
                         relabel(m, 1, 7);
                         relabel(m, 0, 1);
                         relabel(m, 7, 0);
                       }}));
}

}  // namespace
}  // namespace mw::engine
