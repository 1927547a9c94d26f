// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An allocation of the library that fails, whichever it is, is an error of MW_RESOURCE or does no
// harm; it is never a crash, and nothing is left behind.
#include "engine/mwmesh.h"
#include "tests/engine/memory/counted_memory.h"
#include "tests/temp_folder.h"

namespace mwmesh {
namespace {

constexpr Index kShape{9, 8, 7};
constexpr std::uint64_t kNone = ~std::uint64_t{0};

/// Calls call(error) while allocations fail.  Returns how many it asked for.
template <class Call>
std::uint64_t call_failing(std::uint64_t first, bool lasting, const Call& call) {
  mw_error* error = nullptr;
  mw::test::fail_allocations(first, lasting);
  const bool is_done = call(&error);
  const std::uint64_t asked = mw::test::end_failures();
  EXPECT_EQ(is_done, error == nullptr) << first;
  EXPECT_TRUE(is_done || asked >= first) << mw_error_text(error);
  EXPECT_EQ(mw_error_kind(error), is_done ? MW_OK : MW_RESOURCE) << first << mw_error_text(error);
  mw_error_free(error);
  return asked;
}

/// Fails about `times` of the allocations of the call: one by one, then all from there on.
template <class Call>
void expect_errors(const char* name, const Call& call, std::uint64_t times = 100'000) {
  SCOPED_TRACE(name);
  (void)call_failing(kNone, false, call);  // makes what stays
  const std::uint64_t all = call_failing(kNone, false, call);
  EXPECT_GT(all, 0U);
  for (const bool lasting : {false, true}) {
    const std::uint64_t before = mw::test::allocated_bytes();
    for (std::uint64_t n = 1; n <= all; n += all / times + 1) {
      (void)call_failing(n, lasting, call);
    }
    EXPECT_EQ(mw::test::allocated_bytes(), before) << lasting;
  }
}

/// Has what calls take.
class LibraryMemory : public testing::Test {
 protected:
  const std::vector<std::uint64_t> labels_ = synth("voronoi", kShape, 3, 1);
  const Volume volume_ =
      Volume::of(ArrayVolume{.data = labels_.data(), .type = VoxelType::kU64, .shape = kShape});
  const Options options_{{"threads", "1"}, {"certify", "off"}};
  const Mesh mesh_ = mesh(volume_, options_);
  const mw_name name_{.label = 1, .name = "a name that no string keeps inside of itself"};
};

TEST_F(LibraryMemory, OptionsAndVolumes) {
  expect_errors("options", [](mw_error** error) {
    const detail::Owned<mw_options> options(mw_options_new(error));
    return options && mw_options_set(options.get(), "max_distance", "1", error) == MW_OK &&
           mw_options_get(options.get(), "max_distance", error) != nullptr;
  });
  expect_errors("an option that is none", [](mw_error** error) {
    const detail::Owned<mw_options> options(mw_options_new(error));
    if (!options) return false;
    const mw_status kind = mw_options_set(options.get(), "max_distanse", "1", error);
    if (kind != MW_USAGE) return false;
    mw_error_free(std::exchange(*error, nullptr));
    return true;
  });
  std::vector<std::uint64_t> voxels(labels_.size());
  expect_errors("volumes", [&](mw_error** error) {
    const detail::Owned<mw_volume> volume(
        mw_volume_of_array(labels_.data(), MW_U64, kShape.data(), nullptr, nullptr, error));
    if (!volume) return false;
    const detail::Owned<mw_volume> named(mw_volume_with_names(volume.get(), &name_, 1, error));
    std::uint64_t label = 0;
    return named && mw_volume_find_label(named.get(), name_.name, &label, error) == MW_OK &&
           mw_volume_read(named.get(), Index{}.data(), kShape.data(), voxels.data(), error) ==
               MW_OK;
  });
}

TEST_F(LibraryMemory, Meshes) {
  const mw::test::TempFolder folder;
  const std::string path = folder.path() / "m.vtu";
  const std::vector<double> numbers(mesh_.tets().size(), 1.0);
  expect_errors("columns", [&](mw_error** error) {
    const detail::Owned<mw_mesh> made(
        mw_mesh_of_arrays(mesh_.points()[0].data(), mesh_.points().size(), mesh_.tets()[0].data(),
                          mesh_.labels().data(), mesh_.tets().size(), 0, error));
    return made && mw_mesh_set_names(made.get(), &name_, 1, error) == MW_OK &&
           mw_mesh_set_values(made.get(), "a", numbers.data(), numbers.size(), error) == MW_OK;
  });
  expect_errors(
      "digest",
      [&](mw_error** error) {
        return detail::Owned<char>(mw_mesh_digest(mesh_.handle(), error)) != nullptr;
      },
      200);
  expect_errors(
      "files",
      [&](mw_error** error) {
        return mw_mesh_write(mesh_.handle(), path.c_str(), nullptr, error) == MW_OK &&
               detail::Owned<mw_mesh>(mw_mesh_read(path.c_str(), error)) != nullptr;
      },
      200);
}

TEST_F(LibraryMemory, Runs) {
  expect_errors(
      "mesh",
      [&](mw_error** error) {
        return detail::Owned<mw_mesh>(
                   mw_make_mesh(volume_.handle(), options_.handle(), nullptr, error)) != nullptr;
      },
      100);
  expect_errors(
      "verify",
      [&](mw_error** error) {
        return detail::Owned<char>(mw_verify(mesh_.handle(), volume_.handle(), options_.handle(),
                                             nullptr, nullptr, error)) != nullptr;
      },
      100);
}

}  // namespace
}  // namespace mwmesh
