// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Values of options, and config files.
#include "engine/cli/options/config_file.h"
#include "engine/request/mesh_request.h"
#include "engine/request/option_set.h"
#include "engine/request/values.h"
#include "engine/settings/size_text.h"
#include "tests/fuzz/all_targets.h"
#include "tests/temp_folder.h"

namespace mw::fuzz {
namespace {

/// Options of `mwmesh mesh`; set up once, for it takes a hundred times as long as a file.
class MeshOptions {
 public:
  MeshOptions() { request::add_mesh_options(options_, request_); }
  std::string effective(const std::filesystem::path& config) {
    options_.resolve({}, cli::read_config(config, options_));
    return options_.toml();
  }

 private:
  request::MeshRequest request_;
  request::OptionSet options_;
};

}  // namespace

/// Each kind of value: its canonical text is a value again, and the same one.
void fuzz_values(Bytes bytes) {
  using request::ValueKind;
  // Values end at a zero byte: arguments of programs have none, and config files none in a value.
  const std::string text(text_of(bytes).substr(0, text_of(bytes).find('\0')));
  for (const ValueKind kind :
       {ValueKind::kText, ValueKind::kInteger, ValueKind::kNumber, ValueKind::kNumberOrNone,
        ValueKind::kNumberOrAuto, ValueKind::kNumbers, ValueKind::kShape, ValueKind::kBox,
        ValueKind::kLabels, ValueKind::kSize, ValueKind::kSwitch, ValueKind::kNumberOrText}) {
    std::string once;
    if (!ends_well([&] { once = request::canonical_text(kind, text); })) continue;
    require(request::canonical_text(kind, once) == once, "canonical text stays as it is");
    static_cast<void>(request::toml_of_text(kind, once));
  }
  ends_well([&] { static_cast<void>(request::parse_element(text)); });
  // "@FILE" would read any file of this machine.
  if (text.find('@') == text.npos) {
    ends_well([&] { static_cast<void>(engine::parse_sizes(text)); });
  }
  ends_well([&] { static_cast<void>(engine::parse_size_table(text, "fuzzed sizes")); });
}

/// A config file is refused, or what --print-config prints of it gives the same once more.
void fuzz_config(Bytes bytes) {
  static MeshOptions options;
  const test::TempFolder folder;
  const std::filesystem::path config = folder.path() / "c.toml";
  const std::filesystem::path printed = folder.path() / "printed.toml";
  std::ofstream(config, std::ios::binary) << text_of(bytes);
  std::string once;
  if (!ends_well([&] { once = options.effective(config); })) return;
  std::ofstream(printed, std::ios::binary) << once;
  require(options.effective(printed) == once, "the printed config gives the same values");
}

}  // namespace mw::fuzz
