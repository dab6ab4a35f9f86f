// Cook's membrane with deal.II, shared among the ranks of MPI and solved by PETSc: its material by piola, and
// again by deal.II's own automatic differentiation of the same energy.
//
// A tapered plate, one layer of Q2 elements whose faces stay in their planes (plane strain), is held at its
// left end and pulled upwards at its right one. `cook [TIP]` returns 1 unless stresses and tangents of the two
// agree to 1e-12 of the largest, and the displacements of the tip to 1e-9, with each other and with TIP, which
// a run on another number of ranks has printed.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/differentiation/ad.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/petsc_solver.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>
#include <deal.II/lac/sparsity_tools.h>

#include "piola.hpp"

namespace {

using namespace dealii;
namespace AD = Differentiation::AD;

// Pa; the ratio of Poisson is 0.3.
constexpr double mu = 80e6, lambda = 120e6;
/// The whole load, Pa, by area at rest of the right end.
constexpr double traction = 12.5e6;

using reals = std::vector<double>;
/// Writes first Piola stresses, 9 numbers each, and tangents, 81 each, of deformation gradients, 9 each: all
/// by rows.
using material = std::function<void(const reals &F, reals &P, reals &dP_dF)>;

/// Automatic differentiation, by Sacado, of piola's "neo-Hookean": μ/2 (F:F - 3) - μ ln J + λ/2 ln² J.
void differentiate(const reals &F, reals &P, reals &dP_dF) {
    const FEValuesExtractors::Tensor<2> entries(0);
    AD::ScalarFunction<3, AD::NumberTypes::sacado_dfad_dfad> energy(9);
    Vector<double> gradient(9);
    FullMatrix<double> hessian(9, 9);
    for (std::size_t point = 0; 9 * point < F.size(); point++) {
        energy.reset();
        energy.register_independent_variable(
            Tensor<2, 3>(ArrayView<const double>(F.data() + 9 * point, 9)), entries);
        const auto F_here = energy.get_sensitive_variables(entries);
        const decltype(energy)::ad_type ln_J = log(determinant(F_here));
        energy.register_dependent_variable(
            mu / 2.0 * (scalar_product(F_here, F_here) - 3.0) - mu * ln_J + lambda / 2.0 * ln_J * ln_J);
        energy.compute_gradient(gradient);
        energy.compute_hessian(hessian);
        std::copy(gradient.begin(), gradient.end(), P.begin() + 9 * point);
        for (unsigned int row = 0; row < 9; row++) {
            for (unsigned int column = 0; column < 9; column++)
                dP_dF[81 * point + 9 * row + column] = hessian(row, column);
        }
    }
}

/// A converged body.
struct solution {
    /// Deformation gradients at the quadrature points of this rank.
    reals F;
    /// The vertical displacement of the upper corner at the right, m.
    double tip;
    std::size_t linearisations;
    /// The least time in which all ranks had stresses and tangents of all points, s.
    double seconds;
};

class membrane {
public:
    explicit membrane(unsigned int cells)
        : triangulation_(MPI_COMM_WORLD), element_(FE_Q<3>(2), 3), dofs_(triangulation_),
          values_(element_, QGauss<3>(3), update_gradients | update_JxW_values) {
        GridGenerator::subdivided_hyper_rectangle(
            triangulation_, {cells, cells, 1}, Point<3>(0, 0, 0), Point<3>(1, 1, 2e-3), true);
        // Boundary 0 is the left end, 1 the right one, 4 and 5 the faces.
        GridTools::transform(
            [](const Point<3> &at) {
                return Point<3>(48e-3 * at[0], 44e-3 * at[0] + (44e-3 - 28e-3 * at[0]) * at[1], at[2]);
            },
            triangulation_);
        dofs_.distribute_dofs(element_);
        owned_ = dofs_.locally_owned_dofs();
        relevant_ = DoFTools::extract_locally_relevant_dofs(dofs_);
        held_.reinit(relevant_);
        const FEValuesExtractors::Scalar z(2);
        DoFTools::make_zero_boundary_constraints(dofs_, 0, held_);
        for (const types::boundary_id face : {4, 5})
            DoFTools::make_zero_boundary_constraints(dofs_, face, held_, element_.component_mask(z));
        held_.close();

        DynamicSparsityPattern pattern(relevant_);
        DoFTools::make_sparsity_pattern(dofs_, pattern, held_, false);
        SparsityTools::distribute_sparsity_pattern(pattern, owned_, MPI_COMM_WORLD, relevant_);
        stiffness_.reinit(owned_, owned_, pattern, MPI_COMM_WORLD);
        out_of_balance_.reinit(owned_, MPI_COMM_WORLD);
        step_.reinit(owned_, MPI_COMM_WORLD);
        load_.reinit(owned_, MPI_COMM_WORLD);
        assemble_load();
    }

    unsigned int points() const {
        return triangulation_.n_global_active_cells() * values_.n_quadrature_points;
    }
    types::global_dof_index unknowns() const { return dofs_.n_dofs(); }

    /// Newton's method in two equal steps of load.
    solution solve(const material &material) {
        solution solution{reals(9 * local_points()), 0.0, 0, HUGE_VAL};
        reals P(solution.F.size()), dP_dF(9 * solution.F.size());
        PETScWrappers::MPI::Vector displacement(owned_, MPI_COMM_WORLD),
            seen(owned_, relevant_, MPI_COMM_WORLD);
        SolverControl control;
        for (const double share : {0.5, 1.0}) {
            for (unsigned int iteration = 0;; iteration++) {
                seen = displacement;
                deform(seen, solution.F);
                const auto start = std::chrono::steady_clock::now();
                material(solution.F, P, dP_dF);
                const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
                solution.seconds =
                    std::fmin(solution.seconds, Utilities::MPI::max(time.count(), MPI_COMM_WORLD));
                solution.linearisations++;
                assemble(P, dP_dF);
                out_of_balance_.add(share, load_);
                // What is left is rounding; where it is not a number, the method has failed.
                const double residual = out_of_balance_.l2_norm();
                if (residual <= 1e-11 * load_.l2_norm()) break;
                if (!std::isfinite(residual) || iteration == 10)
                    throw std::runtime_error("Newton's method does not converge");
                PETScWrappers::SparseDirectMUMPS mumps(control, MPI_COMM_WORLD);
                mumps.solve(stiffness_, step_, out_of_balance_);
                displacement += step_;
            }
        }
        solution.tip = tip(seen);
        return solution;
    }

private:
    std::size_t local_points() const {
        return std::size_t(triangulation_.n_locally_owned_active_cells()) * values_.n_quadrature_points;
    }

    void assemble_load() {
        FEFaceValues<3> values(element_, QGauss<2>(3), update_values | update_JxW_values);
        const FEValuesExtractors::Scalar y(1);
        std::vector<types::global_dof_index> indices(element_.n_dofs_per_cell());
        for (const auto &cell : dofs_.active_cell_iterators()) {
            for (const auto face : cell->face_indices()) {
                if (!cell->is_locally_owned() || !cell->at_boundary(face) ||
                    cell->face(face)->boundary_id() != 1)
                    continue;
                values.reinit(cell, face);
                cell->get_dof_indices(indices);
                Vector<double> forces(indices.size());
                for (const auto point : values.quadrature_point_indices()) {
                    for (const auto a : values.dof_indices())
                        forces[a] += traction * values[y].value(a, point) * values.JxW(point);
                }
                held_.distribute_local_to_global(forces, indices, load_);
            }
        }
        load_.compress(VectorOperation::add);
    }

    /// Deformation gradients of all quadrature points of this rank: one batch.
    void deform(const PETScWrappers::MPI::Vector &displacement, reals &F) {
        std::vector<Tensor<2, 3>> gradients(values_.n_quadrature_points);
        const FEValuesExtractors::Vector all(0);
        auto next = F.begin();
        for (const auto &cell : dofs_.active_cell_iterators()) {
            if (!cell->is_locally_owned()) continue;
            values_.reinit(cell);
            values_[all].get_function_gradients(displacement, gradients);
            for (const Tensor<2, 3> &gradient : gradients) {
                for (unsigned int entry = 0; entry < 9; entry++)
                    *next++ = gradient[entry / 3][entry % 3] + (entry % 4 == 0 ? 1.0 : 0.0);
            }
        }
    }

    /// The stiffness, and the forces of the elements, which are minus the gradient of their energy.
    void assemble(const reals &P, const reals &dP_dF) {
        stiffness_ = 0.0;
        out_of_balance_ = 0.0;
        const unsigned int size = element_.n_dofs_per_cell();
        FullMatrix<double> matrix(size, size);
        Vector<double> forces(size);
        std::vector<types::global_dof_index> indices(size);
        // dP for the gradient of each shape function.
        std::vector<std::array<double, 9>> dP(size);
        std::size_t at = 0;
        for (const auto &cell : dofs_.active_cell_iterators()) {
            if (!cell->is_locally_owned()) continue;
            values_.reinit(cell);
            cell->get_dof_indices(indices);
            matrix = 0.0;
            forces = 0.0;
            for (const auto point : values_.quadrature_point_indices()) {
                const double *stress = P.data() + 9 * at, *tangent = dP_dF.data() + 81 * at;
                at++;
                // Shape function b moves coordinate k alone: dF has row k, which is its gradient.
                for (const auto b : values_.dof_indices()) {
                    const unsigned int k = element_.system_to_component_index(b).first;
                    const Tensor<1, 3> &gradient = values_.shape_grad(b, point);
                    for (unsigned int entry = 0; entry < 9; entry++) {
                        const double *row = tangent + 9 * entry + 3 * k;
                        dP[b][entry] = row[0] * gradient[0] + row[1] * gradient[1] + row[2] * gradient[2];
                    }
                }
                for (const auto a : values_.dof_indices()) {
                    const unsigned int i = element_.system_to_component_index(a).first;
                    const Tensor<1, 3> gradient = values_.shape_grad(a, point) * values_.JxW(point);
                    const auto against = [&](const double *of) {
                        return of[3 * i] * gradient[0] + of[3 * i + 1] * gradient[1] +
                               of[3 * i + 2] * gradient[2];
                    };
                    forces[a] -= against(stress);
                    for (const auto b : values_.dof_indices()) matrix(a, b) += against(dP[b].data());
                }
            }
            held_.distribute_local_to_global(matrix, forces, indices, stiffness_, out_of_balance_);
        }
        stiffness_.compress(VectorOperation::add);
        out_of_balance_.compress(VectorOperation::add);
    }

    double tip(const PETScWrappers::MPI::Vector &displacement) const {
        double tip = -HUGE_VAL;
        for (const auto &cell : dofs_.active_cell_iterators()) {
            for (const auto vertex : cell->vertex_indices()) {
                if (cell->is_locally_owned() &&
                    cell->vertex(vertex).distance(Point<3>(48e-3, 60e-3, 0)) < 1e-9)
                    tip = displacement[cell->vertex_dof_index(vertex, 1)];
            }
        }
        return Utilities::MPI::max(tip, MPI_COMM_WORLD);
    }

    parallel::distributed::Triangulation<3> triangulation_;
    FESystem<3> element_;
    DoFHandler<3> dofs_;
    FEValues<3> values_;
    IndexSet owned_, relevant_;
    AffineConstraints<double> held_;
    PETScWrappers::MPI::SparseMatrix stiffness_;
    PETScWrappers::MPI::Vector out_of_balance_, step_, load_;
};

/// The largest difference of two arrays by the largest number of the first, over all ranks.
double distance(const reals &a, const reals &b) {
    double difference = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < a.size(); k++) {
        const double apart = std::fabs(a[k] - b[k]);
        difference = std::fmax(difference, std::isnan(apart) ? HUGE_VAL : apart);
        largest = std::fmax(largest, std::fabs(a[k]));
    }
    return Utilities::MPI::max(difference, MPI_COMM_WORLD) / Utilities::MPI::max(largest, MPI_COMM_WORLD);
}

} // namespace

int main(int count, char **arguments) try {
    Utilities::MPI::MPI_InitFinalize mpi(count, arguments, 1);
    const piola::batch<double> rubber(
        piola::material(piola::energy::named("neo-Hookean"), {{"mu", {mu}}, {"lambda", {lambda}}}, 0.0));
    const auto evaluate = [&](const reals &F, reals &P, reals &dP_dF) {
        if (!rubber.tangents(F, P, dP_dF).is_clean()) throw std::runtime_error("an element is inverted");
    };

    membrane membrane(16);
    const solution ours = membrane.solve(evaluate), theirs = membrane.solve(differentiate);
    reals P(ours.F.size()), dP_dF(9 * P.size()), P_expected(P.size()), dP_dF_expected(dP_dF.size());
    evaluate(ours.F, P, dP_dF);
    differentiate(ours.F, P_expected, dP_dF_expected);
    const double stresses = distance(P_expected, P), tangents = distance(dP_dF_expected, dP_dF),
                 tips = std::fabs(ours.tip / theirs.tip - 1.0),
                 ranks = count > 1 ? std::fabs(ours.tip / std::atof(arguments[1]) - 1.0) : 0.0;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0) {
        std::printf(
            "%u points, %u unknowns, %u ranks; linearised %zu times with piola, %zu with automatic "
            "differentiation\n",
            membrane.points(), unsigned(membrane.unknowns()), Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
            ours.linearisations, theirs.linearisations);
        std::printf(
            "differences: stresses %.1e, tangents %.1e, tips %.1e, ranks %.1e\n", stresses, tangents, tips,
            ranks);
        std::printf("automatic differentiation takes %.1f times as long\n", theirs.seconds / ours.seconds);
        std::printf("tip %.15e\n", ours.tip);
    }
    return stresses <= 1e-12 && tangents <= 1e-12 && tips <= 1e-9 && ranks <= 1e-9 ? 0 : 1;
} catch (const std::exception &error) {
    std::cerr << error.what() << "\n";
    MPI_Abort(MPI_COMM_WORLD, 1);
}
