/* SPDX-FileCopyrightText: The mwmesh authors
 * SPDX-License-Identifier: Apache-2.0
 * A program of somebody else in C: meshes the voxels of a file and prints the digest of their mesh,
 * once all else that the interface promises was tried. */
#include <mwmesh_c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kX = 24, kY = 20, kZ = 16, kVoxels = kX * kY * kZ };

static unsigned char voxels[kVoxels];

#define EXPECT(what) \
  if (!(what)) fail(#what, __LINE__, error)

static void fail(const char* what, int line, const mw_error* error) {
  fprintf(stderr, "main.c:%d: %s: %s\n", line, what, mw_error_text(error));
  exit(1);
}

/* Frees the error, which must be of this kind and about this option. */
static void expect_error(mw_error** taken, mw_status kind, const char* option, int line) {
  mw_error* error = *taken;
  if (mw_error_kind(error) != kind) fail("the kind of an error", line, error);
  if (strcmp(mw_error_option(error), option) != 0) fail("the option of an error", line, error);
  if (strlen(mw_error_text(error)) < 10) fail("the text of an error", line, error);
  mw_error_free(error);
  *taken = NULL;
}

static int read_box(void* data, const int64_t lo[3], const int64_t hi[3], uint64_t* labels) {
  const unsigned char* from = data;
  int64_t x, y, z;
  if (from == NULL) return 1;
  for (z = lo[2]; z < hi[2]; ++z) {
    for (y = lo[1]; y < hi[1]; ++y) {
      for (x = lo[0]; x < hi[0]; ++x) *labels++ = from[x + kX * (y + kY * z)];
    }
  }
  return 0;
}

/* What hooks saw. */
struct seen {
  uint64_t done, total;
  int stop_at_first, stop;
};

static void see_progress(void* data, uint64_t done, uint64_t total, double seconds_left) {
  struct seen* seen = data;
  (void)seconds_left;
  seen->done = done;
  seen->total = total;
  if (seen->stop_at_first) __atomic_store_n(&seen->stop, 1, __ATOMIC_RELAXED);
}

static int always(void* data) {
  (void)data;
  return 1;
}

static void try_options(mw_options* options) {
  mw_error* error = NULL;
  EXPECT(mw_options_set(options, "max-distance", "1.25", &error) == MW_OK);
  EXPECT(strcmp(mw_options_get(options, "max_distance", &error), "1.25") == 0);
  EXPECT(mw_options_set(options, "max_distance", NULL, &error) == MW_OK);
  EXPECT(strcmp(mw_options_get(options, "max_distance", &error), "1.5") == 0);
  EXPECT(mw_options_set(options, "max_distanse", "1", &error) == MW_USAGE);
  EXPECT(strstr(mw_error_text(error), "max_distance") != NULL);
  expect_error(&error, MW_USAGE, "", __LINE__);
  EXPECT(mw_options_set(options, "window", "5", &error) == MW_USAGE);
  expect_error(&error, MW_USAGE, "window", __LINE__);
  EXPECT(mw_options_set(options, "window", "5", NULL) == MW_USAGE);
  EXPECT(mw_options_get(options, "zzzz", NULL) == NULL);
  EXPECT(mw_options_table() != NULL);
  EXPECT(strstr(mw_options_table(), "\"max_distance\"") != NULL);
}

static void try_hooks(const mw_volume* volume, const mw_options* options) {
  mw_error* error = NULL;
  struct seen seen = {0, 0, 0, 0};
  mw_hooks hooks = {0};
  hooks.size = sizeof hooks;
  hooks.data = &seen;
  hooks.progress = see_progress;
  hooks.stop = &seen.stop;
  mw_mesh_free(mw_make_mesh(volume, options, &hooks, &error));
  EXPECT(error == NULL && seen.done > 0 && seen.done == seen.total);
  seen.stop_at_first = 1;
  EXPECT(mw_make_mesh(volume, options, &hooks, &error) == NULL);
  expect_error(&error, MW_CANCELLED, "", __LINE__);
  EXPECT(mw_make_mesh(volume, options, &hooks, NULL) == NULL);
  hooks.stop = NULL;
  hooks.cancel = always;
  EXPECT(mw_make_mesh(volume, options, &hooks, &error) == NULL);
  expect_error(&error, MW_CANCELLED, "", __LINE__);
}

static void try_readers(const mw_options* options, const char* wanted) {
  static const int64_t shape[3] = {kX, kY, kZ}, lo[3] = {0, 0, 0}, beyond[3] = {kX, kY, kZ + 1};
  mw_error* error = NULL;
  uint64_t* labels = malloc(kVoxels * sizeof *labels);
  mw_volume* volume = mw_volume_of_reader(MW_U8, shape, NULL, NULL, read_box, voxels, &error);
  mw_mesh* mesh = mw_make_mesh(volume, options, NULL, &error);
  char* digest = mw_mesh_digest(mesh, &error);
  EXPECT(digest != NULL && strcmp(digest, wanted) == 0);
  EXPECT(mw_volume_read(volume, lo, shape, labels, &error) == MW_OK);
  EXPECT(labels[7 + kX * (10 + kY * 8)] == 1);
  EXPECT(mw_volume_read(volume, lo, beyond, labels, &error) == MW_USAGE);
  expect_error(&error, MW_USAGE, "", __LINE__);
  mw_free(digest);
  mw_mesh_free(mesh);
  mw_volume_free(volume);
  volume = mw_volume_of_reader(MW_U8, shape, NULL, NULL, read_box, NULL, &error);
  EXPECT(volume != NULL && mw_make_mesh(volume, options, NULL, &error) == NULL);
  expect_error(&error, MW_CALLBACK, "", __LINE__);
  EXPECT(mw_volume_read(volume, lo, shape, labels, &error) == MW_CALLBACK);
  expect_error(&error, MW_CALLBACK, "", __LINE__);
  mw_volume_free(volume);
  free(labels);
}

static void try_mesh(const mw_mesh* mesh, const mw_volume* volume, const mw_options* options) {
  mw_error* error = NULL;
  mw_column points, tets, labels;
  size_t t, bytes = 0;
  int passed = 0;
  char* text;
  EXPECT(mw_mesh_column(mesh, "points", &points, &error) == MW_OK);
  EXPECT(mw_mesh_column(mesh, "tets", &tets, &error) == MW_OK);
  EXPECT(mw_mesh_column(mesh, "labels", &labels, &error) == MW_OK);
  EXPECT(points.type == MW_F64 && points.width == 3 && points.rows > 0);
  EXPECT(tets.type == MW_U64 && tets.width == 4 && tets.rows == labels.rows);
  for (t = 0; t < 4 * tets.rows; ++t) EXPECT(((const uint64_t*)tets.data)[t] < points.rows);
  EXPECT(mw_mesh_column(mesh, "colours", &labels, &error) == MW_USAGE);
  expect_error(&error, MW_USAGE, "", __LINE__);
  EXPECT(strstr(mw_mesh_text(mesh, "report"), "\"digest\"") != NULL);
  EXPECT(mw_mesh_text(mesh, "riddle") == NULL);
  text = mw_mesh_picture(mesh, 64, 48, &bytes, &error);
  EXPECT(text != NULL && bytes > 8 && memcmp(text, "\x89PNG", 4) == 0);
  mw_free(text);
  text = mw_verify(mesh, volume, options, NULL, &passed, &error);
  EXPECT(text != NULL && passed && strstr(text, "\"checks\"") != NULL);
  mw_free(text);
}

static void try_files(const mw_mesh* mesh, const mw_volume* volume, const mw_options* options,
                      const char* path, const char* wanted) {
  mw_error* error = NULL;
  char *report = NULL, *digest;
  mw_mesh* back;
  EXPECT(mw_mesh_write(mesh, path, options, &error) == MW_OK);
  EXPECT(mw_mesh_to_file(path, volume, options, NULL, &report, &error) == MW_OK);
  EXPECT(report != NULL && strstr(report, wanted) != NULL);
  back = mw_mesh_read(path, &error);
  digest = mw_mesh_digest(back, &error);
  EXPECT(digest != NULL && strcmp(digest, wanted) == 0);
  mw_free(report);
  mw_free(digest);
  mw_mesh_free(back);
  EXPECT(mw_mesh_read("/nowhere/m.vtu", &error) == NULL);
  expect_error(&error, MW_INPUT, "", __LINE__);
  EXPECT(mw_volume_open("/nowhere/v.npy", options, NULL, &error) == NULL);
  EXPECT(strstr(mw_error_text(error), "/nowhere/v.npy") != NULL);
  expect_error(&error, MW_INPUT, "", __LINE__);
  EXPECT(mw_volume_open("/nowhere/v.npy", NULL, NULL, NULL) == NULL);
}

/* VOXELS MESH OPTIMIZER: a file of 24 x 20 x 16 bytes, and one that is written. */
int main(int argc, char** argv) {
  static const int64_t shape[3] = {kX, kY, kZ};
  mw_error* error = NULL;
  mw_options* options = mw_options_new(&error);
  FILE* file = argc == 4 ? fopen(argv[1], "rb") : NULL;
  mw_volume* volume;
  mw_mesh* mesh;
  char* digest;
  EXPECT(file != NULL && fread(voxels, 1, kVoxels, file) == kVoxels);
  fclose(file);
  EXPECT(options != NULL && strlen(mw_version()) >= 5);
  try_options(options);
  EXPECT(mw_options_set(options, "optimizer", argv[3], &error) == MW_OK);
  volume = mw_volume_of_array(voxels, MW_U8, shape, NULL, NULL, &error);
  EXPECT(volume != NULL);
  mesh = mw_make_mesh(volume, options, NULL, &error);
  EXPECT(mesh != NULL);
  digest = mw_mesh_digest(mesh, &error);
  EXPECT(digest != NULL);
  try_hooks(volume, options);
  try_readers(options, digest);
  try_mesh(mesh, volume, options);
  try_files(mesh, volume, options, argv[2], digest);
  puts(digest);
  mw_free(digest);
  mw_mesh_free(mesh);
  mw_volume_free(volume);
  mw_options_free(options);
  mw_mesh_free(NULL);
  mw_volume_free(NULL);
  mw_options_free(NULL);
  mw_error_free(NULL);
  mw_free(NULL);
  return 0;
}
