// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A mesh is delivered only when it passes its own check.
#include "engine/job/certificate_plan.h"

#include <nlohmann/json.hpp>

#include "engine/labels/reading_tiles.h"
#include "engine/verify/verify_mesh.h"
#include "kernels/core/error.h"
#include "tests/engine/cli/run_program.h"
#include "tests/engine/memory_run.h"
#include "tests/temp_folder.h"

namespace mw::cli {
namespace {

using engine::test::MemoryVolume;
using nlohmann::json;

constexpr std::uint64_t kGibibyte = std::uint64_t{1} << 30U;

audit::test::SmallVolume volume_of_two_labels() {
  return audit::test::volume_from({6, 5, 4}, 2, [](auto x, auto y, auto) { return x + y > 4; });
}

class CertifyTest : public testing::Test {
 protected:
  /// Returns what a certificate says against a mesh of the volume.
  std::string objection(const audit::test::SmallMesh& mesh) {
    const ::mw::test::TempFolder folder;
    engine::MeshJob job{.folder = folder.path()};
    job.run.threads = 2;
    job.run.store.memory = kGibibyte;
    const MemoryVolume volume(volume_, {});
    const io::LabelTable table = io::collect_labels(volume);
    const io::DenseVolume labels(volume, table);
    io::MeshData data;
    data.vertices = mesh.vertices;
    data.tets = mesh.tets;
    for (const Label l : mesh.labels) data.labels.push_back(table.raw(l));
    io::ScratchMesh stored(folder.path());
    io::ScratchMeshSink into(stored);
    io::write_mesh(data, into);
    const engine::CertificateTask task = certificate_task(
        engine::plan_certificate(job), job, labels, {.max_distance = 1.5, .quality_floor = 0.2});
    try {
      EXPECT_TRUE(certify(stored, task, [] {}).passed());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kCheckFailed);
      return error.what();
    }
    return "";
  }

  audit::test::SmallVolume volume_ = volume_of_two_labels();
  audit::test::SmallMesh mesh_ = audit::test::five_tet_mesh(volume_);
};

TEST_F(CertifyTest, PassesAGoodMesh) {
  EXPECT_EQ(objection(mesh_), "");
}

TEST_F(CertifyTest, RefusesABadMesh) {
  auto turned = mesh_;
  std::swap(turned.tets[9][0], turned.tets[9][1]);
  EXPECT_NE(objection(turned).find("P2 orientation"), std::string::npos);
  auto relabelled = mesh_;
  relabelled.labels[7] = 1 - relabelled.labels[7];
  EXPECT_NE(objection(relabelled).find("P1 topology"), std::string::npos);
  auto flat = mesh_;
  for (audit::Position& p : flat.vertices) p[2] *= 0.01;
  EXPECT_NE(objection(flat).find("P2 volume"), std::string::npos);
}

class CertificateTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    expect_done("synth voronoi --shape 24,20,18 --labels 4 --seed 1 -o v.npy");
  }
  json certificate(const std::string& options) {
    expect_done("mesh v.npy -o v.vtu --report r.json " + options);
    report_ = json::parse(read("r.json"));
    return report_["certificate"];
  }
  static std::set<std::string> checks_of(const json& certificate) {
    std::set<std::string> names;
    for (const json& check : certificate["checks"]) names.insert(check["name"]);
    return names;
  }
  json report_;
};

TEST_F(CertificateTest, IsInTheReport) {
  const json made = certificate("--memory 1GiB");
  EXPECT_EQ(made["made"], true);
  EXPECT_EQ(made["volume"], 24 * 20 * 18);
  for (const json& check : made["checks"]) EXPECT_EQ(check["passed"], true) << check;
  EXPECT_EQ(report_["topology"]["checked"], true);
  EXPECT_LE(report_["distance"]["max_voxels"], 1.5 + 1e-6);
  for (const json& row : report_["shape"]["per_label"]) {
    EXPECT_EQ(row["betti_of_volume"], row["betti_of_mesh"]);
    EXPECT_GE(row["betti_of_mesh"]["closed"][0], 1);
  }
}

/// Without a bound nobody sees a distance but the reader of a report.
TEST_F(CertificateTest, MeasuresDistancesForABoundOrAReport) {
  const audit::test::SmallVolume voxels = volume_of_two_labels();
  const MemoryVolume volume(voxels, {});
  const io::LabelTable table = io::collect_labels(volume);
  const io::DenseVolume labels(volume, table);
  engine::MeshJob job;
  job.run.store.memory = kGibibyte;
  for (const bool is_measured : {false, true}) {
    job.is_measured = is_measured;
    const engine::CertificateTask task =
        certificate_task(engine::plan_certificate(job), job, labels, {.quality_floor = 0.2});
    EXPECT_EQ(task.check.options.measure_distance, is_measured);
  }
  const json made = certificate("--memory 1GiB --preset draft");
  EXPECT_EQ(made["made"], true);
  EXPECT_GT(report_["distance"]["max_voxels"], 0.0);
}

TEST_F(CertificateTest, SaysWhyThereIsNone) {
  EXPECT_NE(certificate("--memory 128MiB")["why"].get<std::string>().find("352"),
            std::string::npos);
  EXPECT_EQ(certificate("--certify off")["why"], "not asked for");
  EXPECT_EQ(report_["topology"]["checked"], false);
  expect_failure(2, "mesh v.npy -o v.vtu --certify on --memory 128MiB", "--certify on: needs");
}

/// More memory must not make a run impossible.
TEST(CertificatePlan, IsDroppedWhereTheRunWouldNotFitBesideIt) {
  engine::MeshJob job;
  job.run.threads = 2;
  job.run.store.memory = kGibibyte;
  const engine::CertificatePlan plan = engine::plan_certificate(job);
  EXPECT_EQ(engine::beside_others(plan, job, kGibibyte / 4).threads, 2);
  const std::uint64_t most = kGibibyte - plan.memory_bytes;
  EXPECT_EQ(engine::beside_others(plan, job, most + 1).threads, 1);
  EXPECT_NE(engine::beside_others(plan, job, kGibibyte).why_not.find("needs --memory 1112MiB"),
            std::string::npos);
  job.certify = engine::Certify::kOn;
  EXPECT_EQ(engine::beside_others(plan, job, kGibibyte).why_not, "");
}

/// A volume far away, of which nothing is read.
class FarVolume : public io::LabelVolume {
 public:
  FarVolume() { info_.is_far = true; }
  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  void read(const Box3& /*box*/, std::span<RawLabel> /*out*/) const override { FAIL(); }
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override {
    return 1000 + kEach * static_cast<std::uint64_t>(threads);
  }

  static constexpr std::uint64_t kEach = 1 << 20;

 private:
  io::VolumeInfo info_;
};

TEST(CertificatePlan, CountsTheReadersOfAVolumeFarAway) {
  engine::MeshJob job;
  job.run.store.memory = kGibibyte;
  const std::uint64_t each = engine::reader_bytes(FarVolume());
  EXPECT_GT(each, FarVolume::kEach + engine::ReadingTiles::kMaxVoxels * sizeof(Label));
  const std::vector<std::pair<int, int>> readers{{1, 8}, {2, 4}, {3, 3}};
  for (const auto& [threads, of_thread] : readers) {
    job.run.threads = threads;
    const engine::CertificatePlan near = engine::plan_certificate(job);
    const engine::CertificatePlan far = engine::plan_certificate(job, each);
    EXPECT_EQ(near.readers, 1);
    EXPECT_EQ(far.threads, threads);
    EXPECT_EQ(far.readers, of_thread);
    EXPECT_EQ(far.memory_bytes,
              near.memory_bytes + static_cast<std::uint64_t>(threads * of_thread) * each);
  }
}

/// Threads are given up first, and then readers.
TEST(CertificatePlan, HasFewerReadersWhereMemoryIsLittle) {
  engine::MeshJob job;
  job.run.threads = 2;
  const std::uint64_t each = engine::reader_bytes(FarVolume());
  const auto planned = [&](std::uint64_t mebibytes) {
    job.run.store.memory = mebibytes << 20U;
    const engine::CertificatePlan plan = engine::plan_certificate(job, each);
    EXPECT_LE(plan.memory_bytes, job.run.store.memory / 4);
    return std::pair(plan.threads, plan.readers);
  };
  EXPECT_EQ(planned(1024), std::pair(2, 4));
  EXPECT_EQ(planned(512), std::pair(1, 8));
  EXPECT_EQ(planned(352 + 4 * 3 * 4), std::pair(1, 3));
  EXPECT_EQ(planned(352), std::pair(1, 1));
  job.run.store.memory = kGibibyte;
  const engine::CertificatePlan plan = engine::plan_certificate(job, each);
  const std::uint64_t others = kGibibyte - (std::uint64_t{88} << 20U) - 5 * each;
  EXPECT_EQ(engine::beside_others(plan, job, others).readers, 5);
}

TEST_F(CertificateTest, IsMadeWhereLabelsAreLeftOut) {
  const json made = certificate("--memory 1GiB --background 1");
  EXPECT_EQ(made["made"], true);
  EXPECT_TRUE(checks_of(made).contains("P2 overlap"));
  for (const json& check : made["checks"]) EXPECT_EQ(check["passed"], true) << check;
  for (const json& row : report_["shape"]["per_label"]) {
    EXPECT_EQ(row["betti_of_volume"], row["betti_of_mesh"]);
    EXPECT_GE(row["betti_of_mesh"]["closed"][0], 1) << row;
  }
}

TEST_F(CertificateTest, CountsInterfacesWhereTheyAreKept) {
  const json made = certificate("--memory 1GiB --topology interfaces");
  EXPECT_EQ(made["made"], true);
  EXPECT_TRUE(checks_of(made).contains("P1 interfaces"));
  EXPECT_TRUE(checks_of(made).contains("P1 meetings"));
  for (const json& check : made["checks"]) EXPECT_EQ(check["passed"], true) << check;
  EXPECT_FALSE(checks_of(certificate("--memory 1GiB --topology interfaces --background 1"))
                   .contains("P1 interfaces"));
}

}  // namespace
}  // namespace mw::cli
