/*
 * piola: invertible isotropic hyperelasticity. This file is made from the sources of the crate piola-c.
 *
 * F is a deformation gradient, 3x3 and dimensionless, its nine numbers row by row: entry (i, j) at 3i+j. P is
 * the first Piola-Kirchhoff stress. Lengths are in m, masses in kg, times in s, stresses, moduli and energy
 * densities in Pa. Nodes, tetrahedra, rows and columns are counted from 0.
 *
 * Functions return PIOLA_CODE_OK, which is 0, or the kind of the error; piola_error_message returns its text.
 * After an error their output is invalid, unless stated here. No exception leaves them.
 *
 * Arrays come with their lengths, in numbers, which are checked. Arrays that are written must not overlap
 * others of the same call. An array of length 0 may be null.
 *
 * Handles are made by functions called ..._new, _named or _declared, which set them to null if they fail,
 * and freed by ..._free. Calls from several threads at a time are allowed, with the same handle too, except for
 * freeing it.
 *
 * Texts are UTF-8 and end with a NUL.
 */


#ifndef PIOLA_H
#define PIOLA_H

#include <stddef.h>
#include <stdint.h>
/* Marks a node without unknowns, such as a pinned one, instead of its first unknown: for piola_csr_new_i32. */
#define PIOLA_NO_UNKNOWN SIZE_MAX


// Result of a function: 0, or the kind of the error. `piola_error_message` returns its text.
typedef enum piola_code {
    // Success.
    PIOLA_CODE_OK = 0,
    // A pointer is null or not aligned, or an array that is written overlaps another one.
    PIOLA_CODE_POINTER = 1,
    // The lengths of arrays do not match.
    PIOLA_CODE_LENGTH = 2,
    // A text is not UTF-8.
    PIOLA_CODE_TEXT = 3,
    // An option, a setting or an entry of an array has a value that is not allowed.
    PIOLA_CODE_VALUE = 4,
    // No energy has this name, these parameters, or these values of them.
    PIOLA_CODE_MATERIAL = 5,
    // A text does not declare an energy; the message shows each mistake at its place.
    PIOLA_CODE_ENERGY = 6,
    // Nodes, tetrahedra, parts and densities are not a valid body.
    PIOLA_CODE_BODY = 7,
    // A sparse matrix does not fit the stiffnesses of these tetrahedra.
    PIOLA_CODE_MATRIX = 8,
    // A step finds no admissible next state. The state before is untouched.
    PIOLA_CODE_STEP = 9,
    // A user-defined function has returned a value other than 0.
    PIOLA_CODE_CALLBACK = 10,
    // Another call uses this handle. Nothing has been done.
    PIOLA_CODE_BUSY = 11,
    // A bug in piola. A handle that was being changed can only be freed.
    PIOLA_CODE_PANIC = 12,
} piola_code;

// The notation of a declaration.
typedef enum piola_notation {
    // The Rust function that `#[piola::material]` takes, such as
    // `fn Rubber([l1, l2, l3]: [f64; 3], mu: f64) -> f64 { mu / 2.0 * (I1 - 3.0) - mu * J.ln() }`.
    PIOLA_NOTATION_RUST = 0,
    // A formula as papers write it, such as `mu/2*(I1 - 3) - mu*ln(J) where J > 0`. Names without another
    // meaning are its parameters, in the order in which they occur.
    PIOLA_NOTATION_FORMULA = 1,
} piola_notation;

// Treatment of the negative eigenvalues of dP/dF.
typedef enum piola_filter {
    // Leaves negative eigenvalues as they are: the exact derivative of the stress.
    PIOLA_FILTER_NONE = 0,
    // Sets negative eigenvalues to zero.
    PIOLA_FILTER_CLAMP = 1,
    // Replaces negative eigenvalues by their absolute values.
    PIOLA_FILTER_ABSOLUTE = 2,
} piola_filter;

// The order of the components of many points in an array, N of each point.
typedef enum piola_layout {
    // Point by point: component k of point p at p N + k.
    PIOLA_LAYOUT_POINTS = 0,
    // Lines of L points, 8 in double precision and 16 in single precision: component k of point p is
    // at (p/L N + k) L + p mod L. Faster. The number of points must be a multiple of L: fill the last line
    // up with identities.
    PIOLA_LAYOUT_LINES = 1,
} piola_layout;

// The instructions to compute with.
typedef enum piola_instructions {
    // The best that the processor has.
    PIOLA_INSTRUCTIONS_BEST = 0,
    // Instructions that every processor has.
    PIOLA_INSTRUCTIONS_PORTABLE = 1,
} piola_instructions;

// Flags of the status of a point.
typedef enum piola_status {
    // The deformation is outside the domain of the energy, and the results are invalid.
    PIOLA_STATUS_REFUSED = 1,
    // The tangent is at a pole, and has a bounded value instead of an infinite one.
    PIOLA_STATUS_BOUNDED = 2,
    // The deformation gradient or a result is infinite or NaN, or nearly so: the results are invalid.
    PIOLA_STATUS_NONFINITE = 4,
    // The filter has changed the tangent.
    PIOLA_STATUS_FILTERED = 8,
} piola_status;

// A measure of stress with the tangent that belongs to it.
//
// Symmetric tensors are six numbers, 11, 22, 33, 23, 13, 12; tangents 36, row by row, which act on strains
// with doubled shears.
typedef enum piola_measure {
    // The second Piola-Kirchhoff stress S and dS/dE.
    PIOLA_MEASURE_SECOND_PIOLA = 0,
    // The Kirchhoff stress and the tangent of its Lie derivative.
    PIOLA_MEASURE_KIRCHHOFF = 1,
    // The Cauchy stress and the spatial tangent of its Truesdell rate.
    PIOLA_MEASURE_CAUCHY = 2,
    // The Cauchy stress and the tangent of the Jaumann rate of the Kirchhoff stress by deformed volume,
    // which is DDSDDE of Abaqus except for the order: number I there is number {0, 1, 2, 5, 4, 3}[I] here.
    PIOLA_MEASURE_JAUMANN = 3,
    // The Cauchy stress and the tangent of the Green-Naghdi rate of the Kirchhoff stress by deformed volume.
    PIOLA_MEASURE_GREEN_NAGHDI = 4,
} piola_measure;

// Vectors of the nodes of a simulation, three numbers each.
typedef enum piola_quantity {
    // Positions, m. If positions are written, pins hold their nodes there.
    PIOLA_QUANTITY_POSITIONS = 0,
    // Velocities, m/s.
    PIOLA_QUANTITY_VELOCITIES = 1,
    // Accelerations at the end of the last step, m/s².
    PIOLA_QUANTITY_ACCELERATIONS = 2,
    // Given forces, N, of constant size and direction. Write an array of length 0 to remove them.
    PIOLA_QUANTITY_FORCES = 3,
    // Forces of the pins, N: three numbers for each pinned node, in ascending order. Read-only.
    PIOLA_QUANTITY_REACTIONS = 4,
} piola_quantity;

// Reason why the iteration of a step has ended.
typedef enum piola_convergence {
    // The gradient, or the remaining distance, fell below the tolerance.
    PIOLA_CONVERGENCE_TOLERANCE = 0,
    // All further gain is below rounding.
    PIOLA_CONVERGENCE_ROUNDING = 1,
    // The limit of iterations is reached.
    PIOLA_CONVERGENCE_LIMIT = 2,
} piola_convergence;

// Second derivatives of a term, valid during the call that receives it.
typedef struct piola_blocks piola_blocks;

// An elastic body at rest. Immutable: threads may share it.
typedef struct piola_body piola_body;

// The places of the stiffnesses of tetrahedra in a sparse matrix of compressed rows. Immutable: threads may
// share it.
typedef struct piola_csr piola_csr;

// An elastic energy without values for its parameters. Immutable: threads may share it.
typedef struct piola_energy piola_energy;

// A material: an energy with values for its parameters, the same for all points, or some for each.
// Immutable: threads may share it.
typedef struct piola_material piola_material;

// Memory to evaluate the energy of a body. Threads may share it: calls wait for each other.
typedef struct piola_response piola_response;

// A body with positions and velocities, which steps change. A call during a call of another thread returns
// PIOLA_CODE_BUSY.
typedef struct piola_simulation piola_simulation;

// Description of a parameter.
typedef struct piola_parameter_description {
    // Its name.
    const char *name;
    // Its documentation, units included.
    const char *documentation;
    // 1 if it takes a list of values, such as one for each term of a sum; 0 if it takes one.
    int32_t is_list;
    // Values of some real material; null if none are known.
    const double *typical;
    // Number of typical values.
    size_t typical_length;
} piola_parameter_description;

// Description of an energy.
typedef struct piola_energy_description {
    // The name by which it is chosen.
    const char *name;
    // Short description, in a sentence or two.
    const char *summary;
    // The energy density as a formula in one line.
    const char *formula;
    // Domain of the energy, such as `J > 0`; empty if it is defined everywhere.
    const char *domain;
    // 1 if it can be continued beyond its domain, for inverted elements; 0 if not.
    int32_t extends;
    // The parameters.
    const struct piola_parameter_description *parameters;
    // Number of parameters.
    size_t parameter_count;
} piola_energy_description;

// Values of a parameter.
typedef struct piola_parameter {
    // Name of the parameter.
    const char *name;
    // Its values, in SI units.
    const double *values;
    // Number of its values at a point: 1, or more for a list.
    size_t length;
    // Distance from the values of a point to those of the next one; 0 if they are the same for all points.
    size_t stride;
} piola_parameter;

// Options of a batch. `piola_options options = {sizeof options};` has the defaults, and so does null.
typedef struct piola_options {
    // `sizeof(piola_options)`, from which the library determines the fields of the header that a program was
    // compiled with.
    size_t size;
    // One of `piola_filter`. Stresses in other measures have tangents without a filter.
    int32_t filter;
    // One of `piola_layout`, of all arrays of a call except for positions, tetrahedra and statuses.
    int32_t layout;
    // One of `piola_instructions`.
    int32_t instructions;
    // 1 to share the points among as many threads as there are processors, or as the environment variable
    // RAYON_NUM_THREADS gives; 0 for the thread of the caller alone. Results have the same bits.
    int32_t threads;
    // Array for the status of each point, flags of `piola_status`; or null.
    uint8_t *statuses;
    // Number of statuses: that of the points, or 0.
    size_t statuses_length;
} piola_options;

// Counts of the statuses of many points. A point that cannot be computed is not an error of a call: look
// here.
typedef struct piola_survey {
    // Number of points outside the domain of the energy.
    size_t refused;
    // Number of points at a pole of the tangent.
    size_t bounded;
    // Number of points with an infinite or NaN deformation or result.
    size_t nonfinite;
    // Number of points where the filter has changed the tangent.
    size_t filtered;
    // Index of the first point with invalid results, refused or nonfinite; SIZE_MAX if there is none.
    size_t first;
} piola_survey;

// The material and the density of a part of a body.
typedef struct piola_part {
    // The material.
    const struct piola_material *material;
    // Mass density at rest, kg/m³.
    double density;
} piola_part;

// A spring of rest length zero from a point of a body to a point in space.
typedef struct piola_spring {
    // Nodes whose positions make the point of the body.
    size_t nodes[4];
    // Their weights: 1, 0, 0, 0 for the first node itself.
    double weights[4];
    // The point in space, m. Between two steps in which the spring at this place of the array has the same
    // nodes and weights it moves evenly.
    double target[3];
    // Stiffness k, N/m: the energy is k/2 times the distance squared.
    double stiffness;
} piola_spring;

// A potential energy of the positions of all nodes, which a simulation adds to that of deformation.
//
// Its functions get `context` and the positions of the `nodes` nodes, three numbers each, m; the same
// positions must give the same bits. They return 0, or another number, which ends the step with
// PIOLA_CODE_CALLBACK. No exception may leave them. They are called by one thread at a time, not necessarily
// the one that called the library, and must not call functions with the handle of the simulation.
typedef struct piola_term {
    // First argument of the functions. It must live as long as the simulation has this term.
    void *context;
    // Writes the energy, J; infinity outside of its domain, which no step will enter.
    int32_t (*energy)(void *context,
                      const double *positions,
                      size_t nodes,
                      double *energy);
    // Adds the gradient of the energy, N, to three numbers for each node.
    int32_t (*add_gradient)(void *context,
                            const double *positions,
                            size_t nodes,
                            double *gradient);
    // Adds the second derivatives of the energy, N/m, by calls of `piola_blocks_add`. Newton's method
    // converges if they are positive semidefinite, so that negative eigenvalues are best left out.
    int32_t (*add_second_derivatives)(void *context,
                                      const double *positions,
                                      size_t nodes,
                                      struct piola_blocks *blocks);
    // Writes the largest share of a displacement, three numbers for each node, with which a line search may
    // begin, above 0 and at most 1: for barriers that a long step could jump over. May be null: 1.
    int32_t (*longest_step)(void *context,
                            const double *positions,
                            const double *displacement,
                            size_t nodes,
                            double *share);
} piola_term;

// Report of a step.
typedef struct piola_step_report {
    // One of `piola_convergence`.
    int32_t convergence;
    // Number of iterations of Newton's method.
    size_t iterations;
    // Number of iterations of the linear solver.
    size_t linear_iterations;
    // Number of trials that left the domain of a material or a term.
    size_t refused_trials;
    // Norm of the gradient over the free nodes before the first iteration, N.
    double first_residual;
    // Norm of the gradient evaluated last, N.
    double residual;
    // Smallest det F of a tetrahedron after the step.
    double min_det;
    // Energy of deformation, J.
    double elastic;
    // Energy of motion, J.
    double kinetic;
    // Energy in the field of gravity, J: 0 at rest.
    double gravity;
    // Energy of the springs, J.
    double springs;
    // Energy in the field of given forces, J: 0 at rest.
    double forces;
    // Energy of the terms, J.
    double terms;
} piola_step_report;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The message of the last call of this thread that did not return 0: UTF-8, one or several lines; empty
// before the first. Valid until the next such call of this thread. Never null.
const char *piola_error_message(void);

// An energy of the catalogue by its name, such as "neo_hookean"; ignores case, spaces, `_` and `-`.
//
// Errors: PIOLA_CODE_MATERIAL for a name that is not in the catalogue; the message lists those that are.
enum piola_code piola_energy_named(const char *name,
                                   struct piola_energy **energy);

// An energy that a text declares, in one of the notations of `piola_notation`. It is compiled here, within
// milliseconds to seconds, and computes what the same declaration compiled by Rust does, to the last bit.
//
// Errors: PIOLA_CODE_ENERGY for mistakes; the message lists all of them, each with its line.
enum piola_code piola_energy_declared(const char *text,
                                      int32_t notation,
                                      struct piola_energy **energy);

// The description of an energy, valid as long as its handle.
enum piola_code piola_energy_describe(const struct piola_energy *energy,
                                      const struct piola_energy_description **description);

// Frees an energy, or does nothing with null. Materials made of it stay.
void piola_energy_free(struct piola_energy *energy);

// Makes a material of an energy and values for all of its parameters, in any order.
//
// `points` is 0 for one material that is the same for any number of points. Otherwise it has exactly
// `points` points, and parameters with a stride have values for each of them: those of point p begin at
// `values[p * stride]`. In a body, points are the tetrahedra of a part, in their order.
//
// `extension` is the behaviour outside the domain of the energy, such as for inverted elements. Between 0
// and 1 it is the stretch below which the energy is continued, which then restores them. 0: such points are
// refused. Negative: 0.1 if the energy can be continued, else 0.
//
// Parameters of a declared energy that are not given have the typical values of the declaration, if it has
// some.
//
// Energies of the catalogue that the library was not compiled with, values for each point, and single
// precision are interpreted, with the same bits. An interpreted energy is compiled at its first use, within
// milliseconds to seconds.
//
// Errors: PIOLA_CODE_MATERIAL for unknown and missing parameters and values out of range; the message names
// them, and the point.
enum piola_code piola_material_new(const struct piola_energy *energy,
                                   const struct piola_parameter *parameters,
                                   size_t parameters_length,
                                   double extension,
                                   size_t points,
                                   struct piola_material **material);

// Moduli at rest, Pa: the shear modulus μ and Lamé's λ. Each pointer may be null. For a material with values
// for each point they are those of the first.
enum piola_code piola_material_moduli(const struct piola_material *material,
                                      double *mu,
                                      double *lambda);

// Frees a material, or does nothing with null. Bodies made of it stay.
void piola_material_free(struct piola_material *material);

// Energy densities, Pa, of deformation gradients F, nine numbers each, row by row: one number for each
// point.
enum piola_code piola_energies(const struct piola_material *material,
                               const struct piola_options *options,
                               const double *F,
                               size_t F_length,
                               double *energies,
                               size_t energies_length,
                               struct piola_survey *survey);

// `piola_energies` in single precision.
enum piola_code piola_energies_f32(const struct piola_material *material,
                                   const struct piola_options *options,
                                   const float *F,
                                   size_t F_length,
                                   float *energies,
                                   size_t energies_length,
                                   struct piola_survey *survey);

// First Piola stresses P, Pa: nine numbers for each F, row by row.
enum piola_code piola_stresses(const struct piola_material *material,
                               const struct piola_options *options,
                               const double *F,
                               size_t F_length,
                               double *P,
                               size_t P_length,
                               struct piola_survey *survey);

// `piola_stresses` in single precision.
enum piola_code piola_stresses_f32(const struct piola_material *material,
                                   const struct piola_options *options,
                                   const float *F,
                                   size_t F_length,
                                   float *P,
                                   size_t P_length,
                                   struct piola_survey *survey);

// Stresses P, Pa, and filtered tangents dP/dF, Pa: 81 numbers for each point, row 3i+j for entry (i, j) of
// P, column 3k+l for entry (k, l) of F.
enum piola_code piola_tangents(const struct piola_material *material,
                               const struct piola_options *options,
                               const double *F,
                               size_t F_length,
                               double *P,
                               size_t P_length,
                               double *dP_dF,
                               size_t dP_dF_length,
                               struct piola_survey *survey);

// `piola_tangents` in single precision.
enum piola_code piola_tangents_f32(const struct piola_material *material,
                                   const struct piola_options *options,
                                   const float *F,
                                   size_t F_length,
                                   float *P,
                                   size_t P_length,
                                   float *dP_dF,
                                   size_t dP_dF_length,
                                   struct piola_survey *survey);

// Stresses in one of the measures of `piola_measure`, Pa, six numbers for each F. Their tangents, Pa, 36
// numbers for each F and without a filter, are computed if there is an array for them: `tangents` may be
// null, with a length of 0.
//
// A point is nonfinite if its stress is, such as the Cauchy stress for a singular F.
enum piola_code piola_stresses_in(const struct piola_material *material,
                                  const struct piola_options *options,
                                  int32_t measure,
                                  const double *F,
                                  size_t F_length,
                                  double *stresses,
                                  size_t stresses_length,
                                  double *tangents,
                                  size_t tangents_length,
                                  struct piola_survey *survey);

// `piola_stresses_in` in single precision.
enum piola_code piola_stresses_in_f32(const struct piola_material *material,
                                      const struct piola_options *options,
                                      int32_t measure,
                                      const float *F,
                                      size_t F_length,
                                      float *stresses,
                                      size_t stresses_length,
                                      float *tangents,
                                      size_t tangents_length,
                                      struct piola_survey *survey);

// Shapes of tetrahedra at rest: ten numbers each, the inverse of Dm row by row, 1/m, and the volume, m³, the
// input of `piola_stiffnesses`. The columns of Dm are x1 - x0, x2 - x0, x3 - x0.
//
// `positions` has three numbers for each node, m; `corners` four nodes, from 0, for each tetrahedron, with
// det Dm > 0, which `piola_turn_tets` brings about.
//
// Errors: PIOLA_CODE_BODY for nodes that do not exist or belong to no tetrahedron, and volumes that are not
// positive beyond rounding; tetrahedra are numbered from 1 in the message.
enum piola_code piola_rest_shapes(const double *positions,
                                  size_t positions_length,
                                  const size_t *corners,
                                  size_t corners_length,
                                  double *rest,
                                  size_t rest_length);

// Swaps two nodes of each tetrahedron with det Dm < 0 in `corners`. The order of nodes is a convention of
// the program that wrote the mesh.
//
// `positions` and `corners` are those of `piola_rest_shapes`. Flat tetrahedra, and those with a node that
// does not exist, remain as they are. `turned`, which may be null, receives the number of swaps.
enum piola_code piola_turn_tets(const double *positions,
                                size_t positions_length,
                                size_t *corners,
                                size_t corners_length,
                                size_t *turned);

// Gradients of the energies of linear tetrahedra in the positions of their nodes, N, and filtered
// stiffnesses, N/m, from deformation gradients F = Ds Dm⁻¹, nine numbers each, and shapes at rest, ten
// numbers each as from `piola_rest_shapes`.
//
// Gradients have 12 numbers, coordinate a of node n at 3n+a: forces are minus these. Stiffnesses have 144
// numbers, row by row: row and column 3n+a for coordinate a of node n.
//
// The filter acts on dP/dF and is pulled back to the nodes.
enum piola_code piola_stiffnesses(const struct piola_material *material,
                                  const struct piola_options *options,
                                  const double *F,
                                  size_t F_length,
                                  const double *rest,
                                  size_t rest_length,
                                  double *gradients,
                                  size_t gradients_length,
                                  double *stiffnesses,
                                  size_t stiffnesses_length,
                                  struct piola_survey *survey);

// `piola_stiffnesses` in single precision.
enum piola_code piola_stiffnesses_f32(const struct piola_material *material,
                                      const struct piola_options *options,
                                      const float *F,
                                      size_t F_length,
                                      const float *rest,
                                      size_t rest_length,
                                      float *gradients,
                                      size_t gradients_length,
                                      float *stiffnesses,
                                      size_t stiffnesses_length,
                                      struct piola_survey *survey);

// Gradients and stiffnesses as from `piola_stiffnesses`, with the nodes at `positions`, three numbers for
// each, m: F = Ds Dm⁻¹ is computed on the way. `corners` has four nodes, from 0, for each tetrahedron.
//
// In lines, `rest`, `gradients` and `stiffnesses` extend to the end of the last line; fill `rest` up with
// shapes of tetrahedra with edges of length 1 along the axes.
//
// Errors: PIOLA_CODE_VALUE for nodes that do not exist.
enum piola_code piola_stiffnesses_at(const struct piola_material *material,
                                     const struct piola_options *options,
                                     const double *positions,
                                     size_t positions_length,
                                     const size_t *corners,
                                     size_t corners_length,
                                     const double *rest,
                                     size_t rest_length,
                                     double *gradients,
                                     size_t gradients_length,
                                     double *stiffnesses,
                                     size_t stiffnesses_length,
                                     struct piola_survey *survey);

// `piola_stiffnesses_at` in single precision.
enum piola_code piola_stiffnesses_at_f32(const struct piola_material *material,
                                         const struct piola_options *options,
                                         const float *positions,
                                         size_t positions_length,
                                         const size_t *corners,
                                         size_t corners_length,
                                         const float *rest,
                                         size_t rest_length,
                                         float *gradients,
                                         size_t gradients_length,
                                         float *stiffnesses,
                                         size_t stiffnesses_length,
                                         struct piola_survey *survey);

// Finds the places of the stiffnesses of tetrahedra in a sparse matrix: row r has the columns
// `columns[row_starts[r]]` to `columns[row_starts[r + 1] - 1]`, in any order, counted from 0. The matrix may
// be whole or one of its triangles; compressed columns work as well, since it is symmetric.
//
// `corners` has four nodes, from 0, for each tetrahedron; `unknowns` the first of the three successive
// unknowns of each of the `nodes` nodes, or PIOLA_NO_UNKNOWN. It may be null, with a length of 0, if node n
// has the unknowns 3n, 3n + 1, 3n + 2. Takes 576 bytes for each tetrahedron.
//
// Errors: PIOLA_CODE_MATRIX for arrays that are not a matrix and for missing entries, PIOLA_CODE_VALUE for
// nodes that do not exist.
enum piola_code piola_csr_new_i32(size_t nodes,
                                  const size_t *corners,
                                  size_t corners_length,
                                  const size_t *unknowns,
                                  size_t unknowns_length,
                                  const int32_t *row_starts,
                                  size_t row_starts_length,
                                  const int32_t *columns,
                                  size_t columns_length,
                                  struct piola_csr **csr);

// `piola_csr_new_i32` for a matrix with indices of 64 bits.
enum piola_code piola_csr_new_i64(size_t nodes,
                                  const size_t *corners,
                                  size_t corners_length,
                                  const size_t *unknowns,
                                  size_t unknowns_length,
                                  const int64_t *row_starts,
                                  size_t row_starts_length,
                                  const int64_t *columns,
                                  size_t columns_length,
                                  struct piola_csr **csr);

// Adds the stiffnesses of all tetrahedra, 144 numbers each from `piola_stiffnesses` in this layout, one of
// `piola_layout`, to the values of the matrix, one for each of its columns. The sums are taken in the order
// of the tetrahedra, on the thread of the caller.
enum piola_code piola_csr_add(const struct piola_csr *csr,
                              int32_t layout,
                              const double *stiffnesses,
                              size_t stiffnesses_length,
                              double *values,
                              size_t values_length);

// `piola_csr_add` in single precision.
enum piola_code piola_csr_add_f32(const struct piola_csr *csr,
                                  int32_t layout,
                                  const float *stiffnesses,
                                  size_t stiffnesses_length,
                                  float *values,
                                  size_t values_length);

// Frees what `piola_csr_new_i32` has made, or does nothing with null.
void piola_csr_free(struct piola_csr *csr);

// Makes a body of nodes at `positions`, three numbers each, m, and tetrahedra, `corners` with four nodes
// each, from 0, and det [x1 - x0, x2 - x0, x3 - x0] > 0, which `piola_turn_tets` brings about.
//
// `part_of` has the part of each tetrahedron, from 0; it may be null, with a length of 0, if there is one
// part. The body keeps its materials, whose handles may be freed.
//
// Errors: PIOLA_CODE_BODY for an invalid body: nodes without tetrahedron, volumes and densities that are not
// positive, a material with values for another number of tetrahedra; the message numbers tetrahedra from 1.
enum piola_code piola_body_new(const double *positions,
                               size_t positions_length,
                               const size_t *corners,
                               size_t corners_length,
                               const size_t *part_of,
                               size_t part_of_length,
                               const struct piola_part *parts,
                               size_t parts_length,
                               struct piola_body **body);

// Lumped masses of the nodes, kg, one number each.
enum piola_code piola_body_masses(const struct piola_body *body,
                                  double *masses,
                                  size_t masses_length);

// Frees a body, or does nothing with null. Simulations of it stay.
void piola_body_free(struct piola_body *body);

// Makes the memory to evaluate the energy of a body, which it keeps.
enum piola_code piola_response_new(const struct piola_body *body,
                                   struct piola_response **response);

// Energy of deformation, J, with the nodes at `positions`, three numbers each, m, and its gradient, N, three
// numbers for each node: **forces are minus this**. If the length of `gradient` is 0, only the energy is
// computed.
//
// The survey, which may be null, counts tetrahedra; energy and gradient are valid if none is refused or
// nonfinite. Shared among threads.
enum piola_code piola_response_evaluate(const struct piola_response *response,
                                        const double *positions,
                                        size_t positions_length,
                                        double *energy,
                                        double *gradient,
                                        size_t gradient_length,
                                        struct piola_survey *survey);

// Frees a response, or does nothing with null.
void piola_response_free(struct piola_response *response);

// Makes a simulation of a body at rest, with the nodes `pins` held, from 0 and in any order.
//
// `settings` is a text in JSON, null for the defaults. Keys that are left out have the first of their
// values:
//
// - `gravity`: `[0, 0, 0]`, m/s²;
// - `damping`: `0`, the rate of damping that is proportional to mass, 1/s;
// - `integrator`: `"implicit_euler"`, `"sdirk2"`, `"sdirk3"`;
// - `newton`: `{"tolerance": 1e-6, "max_iterations": 50, "filtering": …, "linear": …}`, with
//   - `filtering`: `"on_demand"`, `{"always": "none"}`, `{"always": "clamp"}`, `{"always": "absolute"}`,
//   - `linear`: `"automatic"`, `"cholesky"`, and others: see `LinearSolver` of the crate `piola`.
//
// Errors: PIOLA_CODE_VALUE for a node that does not exist and for other settings.
enum piola_code piola_simulation_new(const struct piola_body *body,
                                     const size_t *pins,
                                     size_t pins_length,
                                     const char *settings,
                                     struct piola_simulation **simulation);

// Replaces the settings from the next step on; those that are left out become the defaults.
enum piola_code piola_simulation_set_settings(const struct piola_simulation *simulation,
                                              const char *settings);

// Reads vectors of the nodes, one of `piola_quantity`.
enum piola_code piola_simulation_read(const struct piola_simulation *simulation,
                                      int32_t quantity,
                                      double *numbers,
                                      size_t numbers_length);

// Writes vectors of the nodes, one of `piola_quantity`, all of which must be finite. The body may be
// deformed, collapsed or inverted in any way.
enum piola_code piola_simulation_write(const struct piola_simulation *simulation,
                                       int32_t quantity,
                                       const double *numbers,
                                       size_t numbers_length);

// Replaces the set of pinned nodes. A node that was not pinned before is held where it is.
enum piola_code piola_simulation_set_pins(const struct piola_simulation *simulation,
                                          const size_t *pins,
                                          size_t pins_length);

// Prescribes the positions of pinned nodes after the next step and from then on: three numbers for each of
// `nodes`, m. They move evenly through the step.
enum piola_code piola_simulation_prescribe(const struct piola_simulation *simulation,
                                           const size_t *nodes,
                                           size_t nodes_length,
                                           const double *positions,
                                           size_t positions_length);

// Replaces all springs.
enum piola_code piola_simulation_set_springs(const struct piola_simulation *simulation,
                                             const struct piola_spring *springs,
                                             size_t springs_length);

// Replaces all terms of the energy except for deformation, gravity and springs.
enum piola_code piola_simulation_set_terms(const struct piola_simulation *simulation,
                                           const struct piola_term *terms,
                                           size_t terms_length);

// Compares the derivatives of each term, at the current positions, with differences of its energy and of its
// gradient, in a test by its author. If `is_filtered` is not 0, the second derivatives may exceed the
// differences, as those without negative eigenvalues do.
//
// Errors: PIOLA_CODE_STEP for a derivative that does not fit, or a term that does not act at the positions;
// PIOLA_CODE_CALLBACK if a function of a term has failed.
enum piola_code piola_simulation_check_terms(const struct piola_simulation *simulation,
                                             int32_t is_filtered);

// Advances by `dt`, s; the report may be null. Shared among threads, with the same bits for any number of
// them.
//
// Errors: PIOLA_CODE_STEP if there is no admissible next state: the state before is untouched, and a shorter
// step may succeed, unless the gradient of a term does not fit its energy. PIOLA_CODE_CALLBACK if a function
// of a term has failed: likewise, unless it was the last one of the step, for the energy in the report.
enum piola_code piola_simulation_step(const struct piola_simulation *simulation,
                                      double dt,
                                      struct piola_step_report *report);

// Moves the body towards a minimum of its energy with gravity, forces, springs and terms, within the limits
// of the settings. Then it is at rest. Otherwise like `piola_simulation_step`; PIOLA_CODE_STEP also if
// nothing holds a body whose loads do not balance.
enum piola_code piola_simulation_equilibrate(const struct piola_simulation *simulation,
                                             struct piola_step_report *report);

// Frees a simulation, or does nothing with null.
void piola_simulation_free(struct piola_simulation *simulation);

// Adds the block of second derivatives by the positions of two nodes, nine numbers row by row, N/m, and, for
// two different nodes, its transpose as the block of `column` and `row`: add each pair of nodes once.
//
// The two need not share a tetrahedron. A pair that neither a tetrahedron nor an earlier step has joined
// costs a new symbolic analysis. A node that does not exist ends the step.
enum piola_code piola_blocks_add(struct piola_blocks *blocks,
                                 size_t row,
                                 size_t column,
                                 const double *entries);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* PIOLA_H */
