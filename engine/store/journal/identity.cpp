// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Settings as lines "name = value".
#include "engine/store/journal/identity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "engine/settings/setting_table.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxSettings = 16 << 20;  // those that are expected may have any size
// Sizes of many labels make long lines; those that differ are shown in part.
constexpr std::size_t kMaxShown = 120;
constexpr std::size_t kMaxTold = 8;

using Lines = std::map<std::string, std::string>;

Lines lines_of(const std::string& text) {
  constexpr std::string_view kIs = " = ";
  Lines out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(kIs);
    if (at != line.npos) out[line.substr(0, at)] = line.substr(at + kIs.size());
  }
  return out;
}

std::optional<std::string> value_of(const Lines& lines, const std::string& name) {
  const auto found = lines.find(name);
  return found == lines.end() ? std::nullopt : std::optional(found->second);
}

std::string shown(const std::optional<std::string>& value) {
  return value ? io::printable(*value, kMaxShown) : "(not there)";
}

/// Returns the name of a line; that of a setting is told as the flag.
std::string told_name(const std::string& name) {
  const bool is_setting =
      std::ranges::find(setting_table(), name, &Setting::name) != setting_table().end();
  return (is_setting ? "--" : "") + io::printable(name, kMaxShown);
}

std::string triple(const std::array<double, 3>& v) {
  return io::text(v[0], ",", v[1], ",", v[2]);
}

std::string volume_text(const io::VolumeInfo& volume) {
  const Index3 shape = volume.shape;
  const io::VolumeSpace& space = volume.space;
  return io::text("shape = ", shape.x, ",", shape.y, ",", shape.z, "\n",                    //
                  "type = ", io::name(volume.type), volume.scaled ? ", scaled" : "", "\n",  //
                  "spacing = ", triple(space.spacing), "\n",                                //
                  "axes = ", triple(space.axes[0]), " ", triple(space.axes[1]), " ",
                  triple(space.axes[2]), "\n",  //
                  "origin = ", triple(space.origin), "\n");
}

/// Whether the first corners of a volume, in one space, are within rounding where they are in
/// another.
bool is_near(const io::VolumeSpace& one, const io::VolumeSpace& other) {
  constexpr double kRounding = 1e-6;  // voxels
  for (const io::Vector3& corner : {io::Vector3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    const io::Vector3 there = to_corner(other, to_world(one, corner));
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(std::abs(there[k] - corner[k]) <= kRounding)) return false;
    }
  }
  return true;
}

}  // namespace

std::string settings_in(const fs::path& path, std::string_view expected) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  const std::uintmax_t most = std::max<std::uintmax_t>(kMaxSettings, expected.size() + 1);
  std::string content(failed ? 0 : std::min(size, most), '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(in.gcount()));
  return content;
}

std::string differences(const std::string& before, const std::string& now) {
  const Lines old_lines = lines_of(before), new_lines = lines_of(now);
  if (value_of(old_lines, "results") != value_of(new_lines, "results")) {
    return "it was made by another build of mwmesh, whose results may differ";
  }
  Lines names = old_lines;
  names.insert(new_lines.begin(), new_lines.end());
  std::string out;
  std::size_t told = 0;
  for (const auto& [name, any] : names) {
    const auto was = value_of(old_lines, name), is = value_of(new_lines, name);
    if (was == is) continue;
    if (++told > kMaxTold) continue;
    out +=
        (out.empty() ? "" : "; ") + told_name(name) + " was " + shown(was) + " and is " + shown(is);
  }
  if (told > kMaxTold) out += io::text("; and ", told - kMaxTold, " more");
  return out;
}

std::optional<std::string> saved_value(const fs::path& path, const std::string& name) {
  return value_of(lines_of(settings_in(path / kSettingsFile)), name);
}

std::string first_voxel_text(const io::VolumeInfo& volume) {
  const Index3 first = volume.first;
  return io::text("first voxel = ", first.x, ",", first.y, ",", first.z, "\n");
}

std::string place_differences(const fs::path& path, const io::VolumeInfo& volume) {
  const Lines is = lines_of(volume_text(volume) + first_voxel_text(volume));
  std::string before, now;
  for (const char* name : {"shape", "origin", "first voxel"}) {
    const std::optional<std::string> was = saved_value(path, name);
    if (!was) return {};
    before += io::text(name, " = ", *was, "\n");
    now += io::text(name, " = ", is.at(name), "\n");
  }
  return differences(before, now);
}

io::VolumeSpace settled_space(const fs::path& path, const io::VolumeSpace& space) {
  const Lines lines = lines_of(settings_in(path / kSettingsFile));
  std::string text;
  for (const char* name : {"spacing", "axes", "origin"}) {
    text += value_of(lines, name).value_or("") + " ";
  }
  std::ranges::replace(text, ',', ' ');
  const auto numbers = io::parse_reals(text);
  if (!numbers || numbers->size() != 15) return space;
  io::VolumeSpace out = space;
  auto next = numbers->begin();
  for (io::Vector3* v : {&out.spacing, &out.axes[0], &out.axes[1], &out.axes[2], &out.origin}) {
    for (double& x : *v) x = *next++;
  }
  return is_near(space, out) ? out : space;
}

bool is_identity_of(const fs::path& path, const std::string& settings) {
  return settings_in(path / kSettingsFile, settings) == settings;
}

std::string identity_text(const io::VolumeInfo& volume, const MeshSettings& settings) {
  std::string out = volume_text(volume);
  for (const Setting& setting : setting_table()) {
    const std::string value = setting.text(settings);
    out += setting.name + " = " + (value.empty() ? "none" : value) + "\n";
  }
  return out;
}

}  // namespace mw::engine
