// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Places of the file system.
#include "io/store/place.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/folder.h"
#include "io/file/source/file_source.h"

namespace mw::io {
namespace {

namespace fs = std::filesystem;

class FileSystem : public Store {
 public:
  [[nodiscard]] std::unique_ptr<ByteSource> open(const std::string& name,
                                                 std::uint64_t /*max*/) const override {
    return open_parts(name);
  }
  [[nodiscard]] std::unique_ptr<ByteSource> open_parts(const std::string& name) const override {
    std::error_code ignored;
    if (fs::status(name, ignored).type() == fs::file_type::not_found) return nullptr;
    return std::make_unique<FileSource>(name);
  }
  [[nodiscard]] std::shared_ptr<const ByteSource> open_part(const std::string& name,
                                                            std::uint64_t offset,
                                                            std::uint64_t size,
                                                            std::string label) const override {
    return std::make_shared<BytesPart>(std::make_shared<FileSource>(name), offset, size,
                                       std::move(label));
  }
  [[nodiscard]] std::uint64_t held_bytes(std::uint64_t /*max*/) const override { return 0; }
  [[nodiscard]] bool has_file(const std::string& name) const override {
    std::error_code ignored;
    return fs::is_regular_file(name, ignored);
  }
  [[nodiscard]] std::optional<bool> has_folder(const std::string& name) const override {
    std::error_code ignored;
    return fs::is_directory(name, ignored);
  }
  [[nodiscard]] std::optional<std::vector<std::string>> folders_in(
      const std::string& name) const override {
    std::error_code ignored;
    std::vector<std::string> names = entries_in(name, ignored);
    std::erase_if(names, [&](const std::string& entry) {
      return !fs::is_directory(fs::path(name) / entry, ignored);
    });
    return names;
  }
  [[nodiscard]] bool is_near() const override { return true; }
  [[nodiscard]] std::string below(const std::string& name, std::string_view more) const override {
    return (fs::path(name) / more).string();
  }
  [[nodiscard]] std::optional<std::pair<std::string, std::string>> above(
      const std::string& name) const override {
    std::error_code ignored;  // without a working folder there is nothing above
    const fs::path whole =
        fs::absolute(fs::path(name) / "", ignored).lexically_normal().parent_path();
    if (!whole.has_filename()) return std::nullopt;
    return std::pair(whole.parent_path().string(), whole.filename().string());
  }
};

}  // namespace

Place::Place(const fs::path& path)
    : name_(path.has_filename() ? path.string() : path.parent_path().string()) {
  static const auto kFileSystem = std::make_shared<const FileSystem>();
  store_ = kFileSystem;
}

std::string Place::last_part() const {
  return name_.substr(name_.rfind('/') + 1);
}

std::optional<std::pair<Place, std::string>> Place::parent() const {
  const auto above = store_->above(name_);
  if (!above) return std::nullopt;
  return std::pair(Place(store_, above->first), above->second);
}

}  // namespace mw::io
