// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where settings come from: defaults < config file < environment < flags.
#include <cctype>

#include "io/file/errors.h"
#include "tests/engine/cli/run_program.h"
#include "tests/engine/settings/setting_samples.h"

namespace mw::cli {
namespace {

class ConfigTest : public ProgramTest {
 protected:
  /// The effective line of a key.
  std::string line(const std::string& key, const std::string& arguments,
                   const std::string& prefix = {}) const {
    const std::string out = "\n" + run("mesh --print-config " + arguments, prefix).out;
    const std::size_t begin = out.find("\n" + key + " = ");
    if (begin == std::string::npos) return {};
    return out.substr(begin + 1, out.find('\n', begin + 1) - begin - 1);
  }
};

TEST_F(ConfigTest, StrongestSourceWins) {
  write("c.toml", "window = 40\n");
  const std::string config = "--config c.toml ";
  EXPECT_EQ(line("window", config), "window = 40");
  EXPECT_EQ(line("window", config, "MW_WINDOW=24"), "window = 24");
  EXPECT_EQ(line("window", config + "--window 16", "MW_WINDOW=24"), "window = 16");
  EXPECT_EQ(line("window", "", "MW_WINDOW=24"), "window = 24");
  EXPECT_EQ(line("window", config, "MW_WINDOW="), "window = 40");
}

/// A setting is one entry of a table: flag, variable and config key are there, and its help.
TEST_F(ConfigTest, EverySettingComesFromFlagVariableAndFile) {
  const std::string help = run("mesh --help-all").out;
  for (const engine::Setting& setting : engine::setting_table()) {
    const std::string text = engine::test::samples(setting).good.front();
    std::string key = setting.name;
    std::replace(key.begin(), key.end(), '-', '_');
    std::string variable = "MW_" + key;
    std::transform(key.begin(), key.end(), variable.begin() + 3, ::toupper);
    const std::string flag = "--" + setting.name;
    const bool is_switch = setting.kind == engine::ValueKind::kSwitch;
    const std::string printed = line(key, is_switch ? flag : io::text(flag, " ", text));
    EXPECT_NE(printed.find(text), std::string::npos) << flag << ": " << printed;
    EXPECT_NE(printed, line(key, "")) << key;
    EXPECT_EQ(printed, line(key, "", io::text(variable, "=", text))) << variable;
    write("one.toml", printed + "\n");
    EXPECT_EQ(printed, line(key, "--config one.toml")) << key;
    EXPECT_NE(help.find(setting.help), std::string::npos) << flag;
  }
}

/// Weaker than everything that is said of a setting itself, wherever.
TEST_F(ConfigTest, PresetsAreRowsOfValues) {
  EXPECT_EQ(line("surface", "--preset draft"), "surface = \"voxel\"");
  EXPECT_EQ(line("max_distance", "--preset draft"), "max_distance = \"none\"");
  EXPECT_EQ(line("size", "--preset fine"), "size = \"*|*=4.2vox\"");
  EXPECT_EQ(line("size", "--preset fine --size 2"), "size = \"2\"");
  EXPECT_EQ(line("max_distance", "--preset default"), line("max_distance", ""));
  EXPECT_EQ(line("max_distance", "--preset draft --max-distance 2"), "max_distance = 2");
  EXPECT_EQ(line("max_distance", "--preset draft", "MW_MAX_DISTANCE=3"), "max_distance = 3");
  EXPECT_EQ(line("max_distance", "", "MW_PRESET=draft"), "max_distance = \"none\"");
  EXPECT_EQ(line("max_distance", "--preset fine", "MW_PRESET=draft"), "max_distance = 1.5");
  write("c.toml", "preset = \"draft\"\nsurface = \"smooth\"\n");
  EXPECT_EQ(line("surface", "--config c.toml"), "surface = \"smooth\"");
  EXPECT_EQ(line("max_distance", "--config c.toml"), "max_distance = \"none\"");
  expect_done("synth voronoi --shape 8,8,8 --labels 2 --seed 1 -o v.npy");
  const auto said = [&](const std::string& preset) {
    return run("mesh v.npy -o v.vtu " + preset).out;
  };
  EXPECT_NE(said("--preset fine").find("preset      fine sets --size *|*=4.2vox --gradation 1\n"),
            std::string::npos);
  EXPECT_NE(
      said("--preset draft --max-distance 2").find("preset      draft sets --surface voxel\n"),
      std::string::npos);
  EXPECT_EQ(said("").find("preset"), std::string::npos);
  expect_failure(2, "mesh --preset best", "--preset best: expected one of draft, default, fine");
}

TEST_F(ConfigTest, EveryKindOfValueSurvivesPrinting) {
  write("c.toml",
        "input = \"a \\\"b\\\".npy\"\noutput = \"o.vtu\"\nspacing = [1, 0.5, 2e-3]\n"
        "edge_variance = 0.1\nmax_distance = \"none\"\nlabels = [-1, 7]\nshape = [4, 5, 6]\n"
        "dtype = \"i16\"\nprogress = \"jsonl\"\nquality_floor = 0.25\nresume = false\n");
  const std::string printed = run("mesh --config c.toml --print-config").out;
  write("printed.toml", printed);
  const ProgramRun again = run("mesh --config printed.toml --print-config");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out, printed);
  for (const char* expected :
       {"input = \"a \\\"b\\\".npy\"\n", "spacing = [1,0.5,0.002]\n", "edge_variance = 0.1\n",
        "max_distance = \"none\"\n", "labels = \"-1,7\"\n", "shape = [4,5,6]\n"}) {
    EXPECT_NE(printed.find(expected), std::string::npos) << expected << printed;
  }
}

TEST_F(ConfigTest, PrintsNoOtherNamesThanThoseGiven) {
  EXPECT_EQ(line("output", "-o $(printf 'm\\303\\244.vtu')"), "output = \"m\\u00e4.vtu\"");
  EXPECT_EQ(line("output", "-o $(printf 'm\\357\\277\\275.vtu')"), "output = \"m\\ufffd.vtu\"");
  expect_failure(2, "mesh --print-config -o $(printf 'm\\377.vtu')", "bytes that are no UTF-8");
}

TEST_F(ConfigTest, FlagsTakeNegativeNumbers) {
  EXPECT_EQ(line("origin", "--origin -1,-2.5,3"), "origin = [-1,-2.5,3]");
  EXPECT_EQ(line("background", "--background -3"), "background = \"-3\"");
}

TEST_F(ConfigTest, TakesSizesAsNumbersAndAsText) {
  for (const auto& [written, text] : {std::pair{"5", "5"}, {"2.5", "2.5"}, {"\"1=3\"", "1=3"}}) {
    write("c.toml", std::string("size = ") + written + "\n");
    EXPECT_EQ(line("size", "--config c.toml"), std::string("size = \"") + text + "\"");
  }
}

TEST_F(ConfigTest, NamesFileLineAndKey) {
  const auto expect_refused = [&](const std::string& content, const std::string& piece) {
    write("c.toml", content);
    expect_failure(2, "mesh --print-config --config c.toml", piece);
  };
  expect_refused("# one\nwindow = 40\nwindwo = 3\n", "c.toml:3: windwo: unknown key");
  expect_refused("[mesh]\nwindow = 40\n", "c.toml:1: mesh: unknown key");
  expect_refused("output = \"a\\u0000b.vtu\"\n", "c.toml:1: output: has a zero byte in it");
  expect_refused("\nwindow = \"40\"\n", "c.toml:2: window: wrong type; expected an integer");
  expect_refused("window = 40.5\n", "c.toml:1: window: wrong type");
  expect_refused("window = 41\n", "c.toml:1: window = 41: must be");
  expect_refused("spacing = [1, 2]\n", "c.toml:1: spacing");
  expect_refused("spacing = [1, \"2\", 3]\n", "c.toml:1: spacing: wrong type");
  expect_refused("edge_variance = \"some\"\n", "c.toml:1: edge_variance: wrong type");
  expect_refused("edge_variance = nan\n", "c.toml:1: edge_variance");
  expect_refused("resume = 1\n", "c.toml:1: resume: wrong type");
  expect_refused("optimizer = \"best\"\n", "c.toml:1: optimizer = best: expected one of");
  expect_refused("odt_iterations = 0\n", "c.toml:1: odt_iterations = 0");
  expect_refused("window = 40\nwindow = 32\n", "c.toml:2");
  expect_refused("window = = 2\n", "c.toml:1");
  expect_failure(2, "mesh --print-config --config missing.toml", "missing.toml");
  expect_failure(2, "mesh --print-config --config .", "cannot read this config file");
}

TEST_F(ConfigTest, WhatHasNoEndIsNoConfigFile) {
  expect_failure(2, "mesh v.npy -o v.vtu --config /dev/zero", "/dev/zero");
  write("long.toml", std::string((1 << 20) + 1, '#'));
  expect_failure(2, "mesh v.npy -o v.vtu --config long.toml", "long.toml");
}

TEST_F(ConfigTest, DefaultTomlSaysTheDefaults) {
  const std::string file = MW_SOURCE_DIR "/configs/default.toml";
  const ProgramRun with_file = run("mesh --print-config --config " + file);
  EXPECT_EQ(with_file.code, 0) << with_file.err;
  EXPECT_EQ(with_file.out, run("mesh --print-config").out);
}

TEST_F(ConfigTest, PaperTomlIsAccepted) {
  const std::string file = MW_SOURCE_DIR "/configs/paper.toml";
  EXPECT_EQ(line("window", "--config " + file), "window = 40");
  EXPECT_EQ(line("edge_variance", "--config " + file), "edge_variance = 0.1");
  EXPECT_EQ(line("max_distance", "--config " + file), "max_distance = \"none\"");
  EXPECT_EQ(line("optimizer", "--config " + file), "optimizer = \"tetgen\"");
}

}  // namespace
}  // namespace mw::cli
