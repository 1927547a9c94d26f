/* SPDX-FileCopyrightText: The mwmesh authors
 * SPDX-License-Identifier: Apache-2.0
 * The binary interface of libmwmesh in C11: labelled voxels in, a tetrahedral mesh out.
 *
 *   mw_error* error = NULL;
 *   mw_options* options = mw_options_new(&error);
 *   mw_options_set(options, "max_distance", "1", &error);
 *   mw_volume* volume = mw_volume_open("brain.nii.gz", options, NULL, &error);
 *   mw_mesh* mesh = mw_make_mesh(volume, options, NULL, &error);
 *   if (mesh == NULL) fprintf(stderr, "%s\n", mw_error_text(error));
 *
 * Errors: a function that can fail takes `mw_error** error` last.  It returns MW_OK or the kind of
 * the error, or NULL in the place of a handle or a text, and leaves in *error what happened, which
 * the caller frees.  *error is then never NULL, and else stays as it was.  error may be
 * NULL.  A failed allocation is an error as any other (MW_RESOURCE); no exception crosses this
 * interface.
 *
 * Handles (mw_options, mw_volume, mw_mesh, mw_error) belong to the caller, who frees each with its
 * function; that takes NULL, too.  What a handle returns (texts, columns, names) lives as long as
 * the handle and must not be freed; texts of type `char*` are the caller's: mw_free().
 *
 * Threads: all functions may be called by several threads at once, also on the same handle, as long
 * as none of them changes it (mw_..._set...) or frees it.  There is no global state.  Threads that
 * call this library must round to nearest and mask all floating-point exceptions.
 *
 * Units: places are in the unit of the volume, boxes and shapes in voxels, memory in bytes.  Arrays
 * of three are (x, y, z).  Labels are 64-bit numbers; those of signed volumes are in two's
 * complement.  Texts end with a zero byte and are UTF-8; paths are as the system has them. */
#ifndef MWMESH_C_H_
#define MWMESH_C_H_

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MW_PUBLIC __attribute__((visibility("default")))

/* Returns the version of the library that is linked, "MAJOR.MINOR.PATCH". */
MW_PUBLIC const char* mw_version(void);

/* Frees a text, or the bytes of a picture. */
MW_PUBLIC void mw_free(void* memory);

/* --- Errors --- */

typedef enum mw_status {
  MW_OK = 0,
  MW_INTERNAL = 1,     /* an invariant broke: please report it */
  MW_USAGE = 2,        /* an argument or an option that makes no sense */
  MW_INPUT = 3,        /* a volume or file that is unreadable, damaged or unsupported */
  MW_RESOURCE = 4,     /* memory, disk or threads do not suffice */
  MW_CHECK_FAILED = 5, /* the mesh does not pass its own check */
  MW_CANCELLED = 6,    /* mw_hooks.cancel or mw_hooks.stop asked for it */
  MW_CALLBACK = 7      /* a function of the caller's returned that it failed */
} mw_status;

typedef struct mw_error mw_error;

/* Returns the kind of the error; MW_OK for NULL. */
MW_PUBLIC mw_status mw_error_kind(const mw_error* error);
/* Returns one sentence or more that name the thing, the reason and the way out; "" for NULL. */
MW_PUBLIC const char* mw_error_text(const mw_error* error);
/* Returns the name of the option that the error is about, "max_distance"; "" where it is none. */
MW_PUBLIC const char* mw_error_option(const mw_error* error);
MW_PUBLIC void mw_error_free(mw_error* error);

/* --- Options --- */

/* Values of options by name, as text in the form of the command line: "1.5", "none", "true",
 * "1,5-9", "Liver=3,*=5".  The same set may be
 * given to any function, which takes what is its own, and NULL is a set in which nothing is given.
 */
typedef struct mw_options mw_options;

/* Returns a set in which nothing is given. */
MW_PUBLIC mw_options* mw_options_new(mw_error** error);
MW_PUBLIC void mw_options_free(mw_options* options);
/* Gives the option a value, in the place of an earlier one; NULL takes the value away.  Words of a
 * name may be joined by '_' or '-'.  Labels may be given by name; they are looked up, and refused
 * if there are none of that name, when the options meet a volume.
 * ERRORS: MW_USAGE for a name that does not exist, telling the names near to it, and for a value
 * that the option cannot have, telling what it may be. */
MW_PUBLIC mw_status mw_options_set(mw_options* options, const char* name, const char* text,
                                   mw_error** error);
/* Returns the effective value, which is the default where none is given; "" where there is none.
 * The text lives until the options are set or freed.  ERRORS: MW_USAGE for an unknown name. */
MW_PUBLIC const char* mw_options_get(const mw_options* options, const char* name, mw_error** error);
/* Returns all options as JSON, in the order of the documentation: a list of {"name", "kind",
 * "value" (what help calls the value), "help", "group", "default" (null where there is none),
 * "choices" (all that it may be; empty for a number or a list), "calls" (which functions take it:
 * "open", "mesh", "write", "verify"), "setting" (whether the mesh depends on it and reports list
 * it)}.  The text lives as long as the library.  Returns NULL where memory is out. */
MW_PUBLIC const char* mw_options_table(void);

/* --- Watching a run --- */

/* What watches a run; none of it changes the mesh.  Every member may be 0.  Any thread may call the
 * functions, but cancel alone is called by several threads at once. */
typedef struct mw_hooks {
  size_t size; /* sizeof(mw_hooks), by which later versions know which members there are */
  void* data;  /* is given to each function */
  /* Is told after each window how many are done, of how many, and the seconds that are left, NaN
   * where unknown; then, while the mesh is written, some more times with all done. */
  void (*progress)(void* data, uint64_t done, uint64_t total, double seconds_left);
  /* Is asked before each read of voxels, after each window, and about once a second while a server
   * is silent; once it returns other than 0 the run ends with MW_CANCELLED.  A window takes below a
   * second as a rule, and up to half a minute where nearly all voxels differ from their neighbours.
   */
  int (*cancel)(void* data);
  /* Is told, before the first window, what may not be meant. */
  void (*warn)(void* data, const char* line);
  /* A number that is looked at as often as cancel is called; other than 0 ends the run, too.  Any
   * thread may set it. */
  const int* stop;
} mw_hooks;

/* --- Volumes --- */

/* A labelled volume. */
typedef struct mw_volume mw_volume;

#ifdef __cplusplus
#define MW_OF_UNSIGNED : unsigned
#else
#define MW_OF_UNSIGNED
#endif

/* The type of stored labels.  Labels that are floats must be whole numbers.  A number that is no
 * type is refused; C++ lets it be handed over because the enumeration is one of unsigned. */
typedef enum mw_type MW_OF_UNSIGNED {
  MW_U8 = 0,
  MW_U16 = 1,
  MW_U32 = 2,
  MW_U64 = 3,
  MW_I8 = 4,
  MW_I16 = 5,
  MW_I32 = 6,
  MW_I64 = 7,
  MW_F32 = 8,
  MW_F64 = 9
} mw_type;

#undef MW_OF_UNSIGNED

/* Places corners of voxels, counted from the first one: world = origin + sum over i of axes[i] *
 * spacing[i] * corner[i].  Axes have unit length and are at right angles. */
typedef struct mw_space {
  double spacing[3]; /* edges of a voxel, positive */
  double origin[3];  /* first corner of the first voxel */
  double axes[3][3];
  const char* unit;  /* "mm", "um", "nm" and so on; "" or NULL if unknown */
  const char* frame; /* "own", "ras" or "lps"; NULL is "own" */
} mw_space;

/* Fills *space with the space of an array whose indices of voxels `affine` (three rows of a 4 x 4
 * matrix) takes to the world; as in NIfTI, they stand for centres: it is what `mwmesh info` calls
 * affine_of_centres.
 * Where all twelve are floats of 32 bits, they are what their shortest decimals say, as in files.
 * frame is "own", "ras" or "lps", or "voxel" to keep nothing but the edges of a voxel.  spacing, or
 * NULL, has these edges where a file states them beside the matrix; it counts for axes that lie
 * along none of the world's, and only where it is that of the matrix to five digits.
 * ERRORS: MW_INPUT for numbers that are not finite, for axes that are 0 or not at right angles, and
 * for a spacing that is not positive; MW_USAGE for another frame. */
MW_PUBLIC mw_status mw_space_of_affine(const double affine[3][4], const char* frame,
                                       const double* spacing, mw_space* space, mw_error** error);

/* The name and the colour of a label. */
typedef struct mw_name {
  uint64_t label;
  const char* name;  /* "" or NULL where it has none */
  uint8_t colour[4]; /* red, green, blue and opacity */
  int has_colour;    /* 0: there is no colour */
} mw_name;

/* Opens a file or folder of any format that `mwmesh info` reads, or an address, by the options of
 * the groups "Input" and "names".  hooks, or NULL, can end waits for a server and be warned.
 * ERRORS: MW_INPUT naming file, field, reason and way out; MW_USAGE for options that do not fit. */
MW_PUBLIC mw_volume* mw_volume_open(const char* path, const mw_options* options,
                                    const mw_hooks* hooks, mw_error** error);
/* Makes a volume of voxels in memory, which must stay there as long as the volume lives; data is
 * the address of voxel (0, 0, 0), strides are bytes of any sign, or NULL for x fastest without
 * gaps.  space may be NULL: edges of 1 from 0 on.
 * ERRORS: MW_USAGE for an empty or too large shape, and for a space that makes no sense. */
MW_PUBLIC mw_volume* mw_volume_of_array(const void* data, mw_type type, const int64_t shape[3],
                                        const int64_t* strides, const mw_space* space,
                                        mw_error** error);
/* Makes a volume that is fetched box by box, so that it need never be in memory.  read writes the
 * labels of the box lo[0..2] to hi[0..2] (hi not included), x fastest, and returns 0; other than 0
 * ends the run with MW_CALLBACK, and a label that `type` cannot hold with MW_INPUT.  Many threads
 * call it at once, and it is asked for each voxel about three times.  chunk says which boxes are
 * cheapest, those that begin and end at its multiples; NULL if all are alike.
 * ERRORS: those of mw_volume_of_array(). */
MW_PUBLIC mw_volume* mw_volume_of_reader(mw_type type, const int64_t shape[3], const int64_t* chunk,
                                         const mw_space* space,
                                         int (*read)(void* data, const int64_t lo[3],
                                                     const int64_t hi[3], uint64_t* labels),
                                         void* data, mw_error** error);
MW_PUBLIC void mw_volume_free(mw_volume* volume);

/* Returns the volume with these names added; where both name a label, these win.  The new handle
 * does not need the other one. */
MW_PUBLIC mw_volume* mw_volume_with_names(const mw_volume* volume, const mw_name* names,
                                          size_t count, mw_error** error);
/* Returns the volume with names and colours of a file as `--names` takes it.
 * ERRORS: MW_INPUT naming file and line. */
MW_PUBLIC mw_volume* mw_volume_read_names(const mw_volume* volume, const char* path,
                                          mw_error** error);
MW_PUBLIC void mw_volume_shape(const mw_volume* volume, int64_t shape[3]);
MW_PUBLIC mw_type mw_volume_type(const mw_volume* volume);
/* Returns other than 0 where labels may be negative. */
MW_PUBLIC int mw_volume_is_signed(const mw_volume* volume);
MW_PUBLIC void mw_volume_space(const mw_volume* volume, mw_space* space);
/* Points *names to the names of labels, ascending, and returns how many there are. */
MW_PUBLIC size_t mw_volume_names(const mw_volume* volume, const mw_name** names);
/* Writes the labels of a box, x fastest.  ERRORS: MW_USAGE unless the box is in the volume. */
MW_PUBLIC mw_status mw_volume_read(const mw_volume* volume, const int64_t lo[3],
                                   const int64_t hi[3], uint64_t* labels, mw_error** error);
/* Finds the label with this number or name: "7", "-1", "Liver".  A number is that label, even if
 * another label is called so.  A name stands for the label whose name is written the same, or else
 * for the one whose name differs in capitals alone; text in double quotes is always a name.
 * ERRORS: MW_USAGE for a number below 0 where labels are not signed, for one of 2^63 or more where
 * they are, and for a name that no label or that several labels have. */
MW_PUBLIC mw_status mw_volume_find_label(const mw_volume* volume, const char* text, uint64_t* label,
                                         mw_error** error);
/* Writes a random volume, x fastest, of shape[0] * shape[1] * shape[2] labels: "voronoi", "tubes",
 * "spheres", "noise" or "checkerboard".  ERRORS: MW_USAGE. */
MW_PUBLIC mw_status mw_synth(const char* kind, const int64_t shape[3], uint64_t labels,
                             uint64_t seed, uint64_t* voxels, mw_error** error);

/* --- Meshes --- */

/* A conforming mesh of tets with a label each. */
typedef struct mw_mesh mw_mesh;

/* A column of numbers: `rows` rows of `width` numbers, row by row. */
typedef struct mw_column {
  const void* data;
  size_t rows;
  size_t width;
  mw_type type;
} mw_column;

/* Meshes the volume.
 * ENSURES: the promises of the README: topology of every label, a conforming partition, quality
 * floor, distance bound; the same mesh for any number of threads, memory and work folder.
 * ERRORS: all kinds.  MW_CANCELLED, MW_RESOURCE and MW_INPUT may leave work in the work folder, as
 * the text says. */
MW_PUBLIC mw_mesh* mw_make_mesh(const mw_volume* volume, const mw_options* options,
                                const mw_hooks* hooks, mw_error** error);
/* Meshes the volume into a file of any format that `mwmesh convert` writes, which appears under its
 * name only once the mesh is whole, so that the mesh is never in memory.  *report, unless report is
 * NULL, becomes the text of mw_mesh_text(), which the caller frees, or NULL where there is none.
 * ERRORS: also MW_USAGE for what the format has no place for. */
MW_PUBLIC mw_status mw_mesh_to_file(const char* path, const mw_volume* volume,
                                    const mw_options* options, const mw_hooks* hooks, char** report,
                                    mw_error** error);
/* Reads a mesh.  ERRORS: MW_INPUT naming file and place; MW_USAGE for an unknown extension. */
MW_PUBLIC mw_mesh* mw_mesh_read(const char* path, mw_error** error);
/* Makes a mesh of copies of these arrays: rows of three coordinates, rows of four points with
 * positive orientation, and a label for each tet.
 * ERRORS: MW_USAGE for a tet that names a point which is not there. */
MW_PUBLIC mw_mesh* mw_mesh_of_arrays(const double* points, size_t point_count, const uint64_t* tets,
                                     const uint64_t* labels, size_t tet_count, int is_signed,
                                     mw_error** error);
MW_PUBLIC void mw_mesh_free(mw_mesh* mesh);

/* Fills *column: "points" (MW_F64, width 3; world coordinates), "tets" (MW_U64, width 4; rows of
 * points, positive orientation), "labels" (MW_U64 or MW_I64, width 1); of the wedges of no
 * thickness between the two sides of the interfaces that the option cohesive named, "wedges"
 * (MW_U64, width 6: three points of the facet under it, whose normal points to the other side, then
 * the three above them in the same order, which may be equal where an interface ends) and
 * "wedge_labels" (width 2: under it, and on top of it).  ERRORS: MW_USAGE for another name. */
MW_PUBLIC mw_status mw_mesh_column(const mw_mesh* mesh, const char* name, mw_column* column,
                                   mw_error** error);
/* Returns how many columns of values the tets have (option sample, or from a file). */
MW_PUBLIC size_t mw_mesh_value_count(const mw_mesh* mesh);
/* Returns the name of the column `index`, ascending, and fills *column (MW_F64, width 1; NaN where
 * unknown), which must not be NULL.  REQUIRES: index < mw_mesh_value_count(). */
MW_PUBLIC const char* mw_mesh_values(const mw_mesh* mesh, size_t index, mw_column* column);
/* Gives each tet a number under this name.  Files have names of a letter and up to 30 letters,
 * digits and '_'; others are written as such names ("Stress XX" as "Stress_XX").
 * ERRORS: MW_USAGE unless count is the number of tets. */
MW_PUBLIC mw_status mw_mesh_set_values(mw_mesh* mesh, const char* name, const double* numbers,
                                       size_t count, mw_error** error);
/* Points *names to the names of labels, ascending, and returns how many there are. */
MW_PUBLIC size_t mw_mesh_names(const mw_mesh* mesh, const mw_name** names);
MW_PUBLIC mw_status mw_mesh_set_names(mw_mesh* mesh, const mw_name* names, size_t count,
                                      mw_error** error);
/* Adds names and colours of a file as `--names` takes it.  ERRORS: MW_INPUT naming file and line.
 */
MW_PUBLIC mw_status mw_mesh_read_names(mw_mesh* mesh, const char* path, mw_error** error);
/* Returns a text of the mesh: "report", JSON with the keys of `mwmesh mesh --report`, "" where
 * there is none; "record", one line of JSON about the run that made the mesh, which files keep.
 * Returns NULL for another name. */
MW_PUBLIC const char* mw_mesh_text(const mw_mesh* mesh, const char* name);
/* Returns what `mwmesh mesh` prints last, with the options' names of the library: edges, shapes,
 * labels and what to look at.  `report` is a text of mw_mesh_text(mesh, "report"); where it is NULL
 * or "" the facts are measured on the mesh, and there are fewer.  The caller frees the text.
 * ERRORS: MW_INPUT for a text that is no report. */
MW_PUBLIC char* mw_mesh_summary(const mw_mesh* mesh, const char* report, mw_error** error);
/* Returns other than 0 where each eight tets in turn are the straight parts of a curved tet, as
 * from mw_mesh_read().  Written with element=tet10-curved such a mesh has these curved tets again.
 */
MW_PUBLIC int mw_mesh_is_in_parts(const mw_mesh* mesh);
/* Sets what mw_mesh_text(mesh, "record") and mw_mesh_is_in_parts() return. */
MW_PUBLIC mw_status mw_mesh_set_record(mw_mesh* mesh, const char* record, int in_parts,
                                       mw_error** error);
/* Finds a label as mw_volume_find_label() does. */
MW_PUBLIC mw_status mw_mesh_find_label(const mw_mesh* mesh, const char* text, uint64_t* label,
                                       mw_error** error);
/* Writes a mesh into a file by the options element, materials, deck, pairs, ascii and
 * write_values.  ERRORS: also MW_USAGE for what the format has no place for. */
MW_PUBLIC mw_status mw_mesh_write(const mw_mesh* mesh, const char* path, const mw_options* options,
                                  mw_error** error);
/* Returns "sha256:...", which is the same for every format, order of rows and machine; the caller
 * frees it. */
MW_PUBLIC char* mw_mesh_digest(const mw_mesh* mesh, mw_error** error);
/* Returns a PNG of all labels except the one around them, with a legend, as `mwmesh picture` draws
 * it, and its number of bytes; the caller frees it.
 * ERRORS: MW_USAGE for fewer than 16 or more than 8,192 pixels; MW_INPUT if there is nothing to
 * see. */
MW_PUBLIC char* mw_mesh_picture(const mw_mesh* mesh, int width, int height, size_t* bytes,
                                mw_error** error);
/* Checks a mesh against its volume, with the bounds that the mesh's record tells (1.5 voxels and a
 * radius ratio of 0.1 where it tells none).  *passed, unless passed is NULL, becomes other than 0
 * where every check holds.  Returns JSON with the keys of `mwmesh verify --report` but version,
 * settings and performance: "passed", and "checks" of "name", "passed" and "detail".  The caller
 * frees it.  ERRORS: those of reading the volume; a mesh that does not hold is none. */
MW_PUBLIC char* mw_verify(const mw_mesh* mesh, const mw_volume* volume, const mw_options* options,
                          const mw_hooks* hooks, int* passed, mw_error** error);

#ifdef __cplusplus
}
#endif

#endif /* MWMESH_C_H_ */
