// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What mesh says before it begins: of images, of rounded labels, and of many layers.
#include <bit>
#include <cmath>
#include <random>

#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

class WarningsTest : public ProgramTest {
 protected:
  /// Writes v.raw, n^3 voxels of this type, from value(x, y, z).
  template <class Number, class Value>
  void write_raw(Value value, int n = 20) const {
    std::string bytes;
    for (int i = 0; i < n * n * n; ++i) {
      const auto number = static_cast<Number>(value(i % n, i / n % n, i / n / n));
      bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    write("v.raw", bytes);
  }

  static bool is_inside(int x, int y, int z) { return std::hypot(x - 10, y - 10, z - 9) < 6; }
};

TEST_F(WarningsTest, AnImageOfIntegersIsMeshedByForceAlone) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 10);
  write_raw<std::int16_t>(
      [&](int x, int y, int z) { return (is_inside(x, y, z) ? 80 : -50) + noise(random); });
  const std::string mesh = "mesh v.raw --shape 20,20,20 --dtype i16 -o m.vtu";
  expect_failure(2, mesh, "the grey values of an image");
  expect_failure(2, mesh + " --drop-specks 1", "--force meshes it");
  expect_done(mesh + " --force");
}

TEST_F(WarningsTest, LabelsThatAreNearlyWholeAreRoundedWithALine) {
  const std::string mesh = "mesh v.raw --shape 20,20,20 --dtype f32 -o ";
  const auto label = [](int x, int y, int z) { return is_inside(x, y, z) ? 2.0F : 0.0F; };
  write_raw<float>(label);
  const ProgramRun exact = run(mesh + "exact.vtu");
  EXPECT_EQ(exact.code, 0) << exact.err;
  EXPECT_EQ(exact.err.find("rounded"), std::string::npos) << exact.err;
  for (const float off : {2.4e-7F, 9e-4F, -9e-4F}) {
    write_raw<float>([&](int x, int y, int z) { return label(x, y, z) * (1 + off / 2); });
    const ProgramRun near = run(mesh + "near.vtu");
    EXPECT_EQ(near.code, 0) << near.err;
    EXPECT_NE(near.err.find("numbers within 0.001 of whole ones are rounded"), std::string::npos)
        << near.err;
    EXPECT_EQ(run("digest near.vtu").out, run("digest exact.vtu").out);
    expect_done("verify v.raw near.vtu --shape 20,20,20 --dtype f32");
  }
  write_raw<float>([&](int x, int y, int z) { return label(x, y, z) * 1.001F; });
  expect_failure(3, mesh + "far.vtu", "is this an image, or probabilities?");
}

TEST_F(WarningsTest, ManyLayersAreSaidWithTheSpacing) {
  make_volume();
  const std::string mesh = "mesh v.npy --crop 0,0,0,8,8,4 -o m.vtu --spacing 0.5,0.5,";
  const ProgramRun some = run(mesh + "10");
  EXPECT_EQ(some.code, 0) << some.err;
  EXPECT_EQ(some.err.find("layers"), std::string::npos) << some.err;
  const ProgramRun many = run(mesh + "10.5");
  EXPECT_EQ(many.code, 0) << many.err;
  EXPECT_NE(many.err.find("voxels of 0.5 x 0.5 x 10.5 are cut into 1 x 1 x 21 layers"),
            std::string::npos)
      << many.err;
}

TEST_F(WarningsTest, ASizeThatBoundsDoNotAllowIsSaid) {
  write_raw<std::uint8_t>(
      [](int x, int y, int z) { return std::hypot(x - 18, y - 18, z - 18) < 14 ? 1 : 0; }, 36);
  const std::string mesh = "mesh v.raw --shape 36,36,36 --dtype u8 -o m.vtu --size ";
  const std::string said = "are shorter than 0.8 of what was asked";
  const ProgramRun fine = run(mesh + "5");
  EXPECT_EQ(fine.code, 0) << fine.err;
  EXPECT_EQ(fine.err.find(said), std::string::npos) << fine.err;
  const ProgramRun coarse = run(mesh + "16");
  EXPECT_EQ(coarse.code, 0) << coarse.err;
  EXPECT_NE(coarse.err.find(said), std::string::npos) << coarse.err;
  EXPECT_EQ(run(mesh + "16 --max-distance 6").err.find(said), std::string::npos);
}

}  // namespace
}  // namespace mw::cli
