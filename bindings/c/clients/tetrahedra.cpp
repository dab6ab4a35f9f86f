// A beam of tetrahedra that bends under its weight: Newton's method with Eigen, forces and stiffness from
// piola. Returns 1 unless it converges quadratically, to where piola's own simulation comes to rest, and the
// forces of the tetrahedra by the formula of the stress, written out here, carry the weight.
#include <cmath>
#include <cstdio>
#include <vector>

#include <Eigen/LU>
#include <Eigen/Sparse>

#include "piola_eigen.hpp"

namespace {

struct mesh {
    std::vector<double> positions;
    std::vector<std::size_t> corners;

    std::size_t nodes() const { return positions.size() / 3; }
};

/// A box of cubes, each of them six tetrahedra around the same diagonal.
mesh box(std::size_t nx, std::size_t ny, std::size_t nz, double h) {
    mesh mesh;
    const auto node = [&](std::size_t i, std::size_t j, std::size_t k) {
        return (i * (ny + 1) + j) * (nz + 1) + k;
    };
    for (std::size_t i = 0; i <= nx; i++) {
        for (std::size_t j = 0; j <= ny; j++) {
            for (std::size_t k = 0; k <= nz; k++) {
                for (const std::size_t x : {i, j, k}) mesh.positions.push_back(h * double(x));
            }
        }
    }
    const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (std::size_t i = 0; i < nx; i++) {
        for (std::size_t j = 0; j < ny; j++) {
            for (std::size_t k = 0; k < nz; k++) {
                for (int way = 0; way < 6; way++) {
                    std::size_t at[3] = {i, j, k}, corners[4] = {node(i, j, k)};
                    for (int step = 0; step < 3; step++) {
                        at[orders[way][step]]++;
                        corners[step + 1] = node(at[0], at[1], at[2]);
                    }
                    // Odd orders of the axes turn left.
                    if (way >= 3) std::swap(corners[1], corners[2]);
                    mesh.corners.insert(mesh.corners.end(), corners, corners + 4);
                }
            }
        }
    }
    return mesh;
}

/// The sparse matrix of the free unknowns, all zero.
Eigen::SparseMatrix<double> pattern(const mesh &mesh, const std::vector<std::size_t> &unknowns, int size) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t t = 0; t < mesh.corners.size(); t += 4) {
        for (int r = 0; r < 12; r++) {
            for (int c = 0; c < 12; c++) {
                const std::size_t row = unknowns[mesh.corners[t + r / 3]],
                                  column = unknowns[mesh.corners[t + c / 3]];
                if (row != PIOLA_NO_UNKNOWN && column != PIOLA_NO_UNKNOWN) {
                    entries.emplace_back(int(row) + r % 3, int(column) + c % 3, 0.0);
                }
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// Gradient of the energies of all tetrahedra by P = μ (F - F⁻ᵀ) + λ ln J F⁻ᵀ, without piola.
Eigen::VectorXd by_hand(const mesh &mesh, const std::vector<double> &x, double mu, double lambda) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(Eigen::Index(x.size()));
    for (std::size_t t = 0; t < mesh.corners.size(); t += 4) {
        const auto edges = [&](const std::vector<double> &positions) {
            Eigen::Matrix3d edges;
            for (int n = 0; n < 3; n++) {
                for (int c = 0; c < 3; c++) {
                    edges(c, n) = positions[3 * mesh.corners[t + 1 + std::size_t(n)] + std::size_t(c)] -
                                  positions[3 * mesh.corners[t] + std::size_t(c)];
                }
            }
            return edges;
        };
        const Eigen::Matrix3d Dm = edges(mesh.positions), F = edges(x) * Dm.inverse(),
                              inverse = F.inverse().transpose();
        const Eigen::Matrix3d P = mu * (F - inverse) + lambda * std::log(F.determinant()) * inverse;
        const Eigen::Matrix3d H = Dm.determinant() / 6.0 * P * Dm.inverse().transpose();
        for (int n = 0; n < 3; n++)
            gradient.segment<3>(Eigen::Index(3 * mesh.corners[t + 1 + std::size_t(n)])) += H.col(n);
        gradient.segment<3>(Eigen::Index(3 * mesh.corners[t])) -= H.rowwise().sum();
    }
    return gradient;
}

} // namespace

int main() {
    const double density = 1000.0, gravity = 9.81, mu = 1e5, lambda = 4e5;
    const mesh mesh = box(8, 2, 2, 0.05);
    const piola::material rubber(
        piola::energy::named("neo-Hookean"), {{"mu", {mu}}, {"lambda", {lambda}}}, 0.0);
    const std::vector<double> rest = piola::rest_shapes(mesh.positions, mesh.corners);
    const piola::body body(mesh.positions, mesh.corners, rubber, density);
    const std::vector<double> masses = body.masses();

    // The end at x = 0 is held.
    std::vector<std::size_t> unknowns(mesh.nodes(), PIOLA_NO_UNKNOWN), pins;
    std::size_t free = 0;
    for (std::size_t n = 0; n < mesh.nodes(); n++) {
        if (mesh.positions[3 * n] == 0.0) {
            pins.push_back(n);
        } else {
            unknowns[n] = free;
            free += 3;
        }
    }
    Eigen::SparseMatrix<double> K = pattern(mesh, unknowns, int(free));
    const piola::span<const std::int32_t> starts(K.outerIndexPtr(), std::size_t(K.outerSize()) + 1);
    const piola::span<const std::int32_t> indices(K.innerIndexPtr(), std::size_t(K.nonZeros()));
    const piola::csr places(mesh.nodes(), mesh.corners, starts, indices, unknowns);

    const std::size_t tetrahedra = mesh.corners.size() / 4;
    std::vector<double> x = mesh.positions, gradients(12 * tetrahedra), stiffnesses(144 * tetrahedra);
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky(K);
    const piola::batch<double> batch(rubber);

    // Gradient of all energies over the free unknowns, and stiffness, at the positions x.
    const auto linearise = [&](Eigen::VectorXd &gradient) {
        if (!batch.stiffnesses_at(x, mesh.corners, rest, gradients, stiffnesses).is_clean()) return false;
        gradient.setZero(Eigen::Index(free));
        for (std::size_t n = 0; n < mesh.nodes(); n++) {
            if (unknowns[n] != PIOLA_NO_UNKNOWN)
                gradient[Eigen::Index(unknowns[n] + 2)] = masses[n] * gravity;
        }
        for (std::size_t t = 0; t < tetrahedra; t++) {
            for (std::size_t k = 0; k < 12; k++) {
                const std::size_t unknown = unknowns[mesh.corners[4 * t + k / 3]];
                if (unknown != PIOLA_NO_UNKNOWN)
                    gradient[Eigen::Index(unknown + k % 3)] += gradients[12 * t + k];
            }
        }
        K.coeffs().setZero();
        places.add(stiffnesses, piola::span<double>(K.valuePtr(), std::size_t(K.nonZeros())));
        return true;
    };

    Eigen::VectorXd gradient;
    if (!linearise(gradient)) return 1;
    const double first = gradient.norm();
    double residual = first, contraction = 1.0;
    int iterations = 0;
    for (; iterations < 50 && residual > 1e-11 * first; iterations++) {
        cholesky.factorize(K);
        if (cholesky.info() != Eigen::Success) return 1;
        const Eigen::VectorXd step = cholesky.solve(-gradient);
        const std::vector<double> from = x;
        // Half the step as long as it leaves the domain of the material or the gradient grows out of hand.
        for (double share = 1.0;; share /= 2.0) {
            for (std::size_t n = 0; n < mesh.nodes(); n++) {
                for (std::size_t c = 0; unknowns[n] != PIOLA_NO_UNKNOWN && c < 3; c++) {
                    x[3 * n + c] = from[3 * n + c] + share * step[Eigen::Index(unknowns[n] + c)];
                }
            }
            if (linearise(gradient) && gradient.norm() < 2.0 * residual) break;
            if (share < 1e-6) return 1;
        }
        contraction = std::fmin(contraction, gradient.norm() / residual);
        residual = gradient.norm();
    }
    std::printf(
        "%zu tetrahedra: %d iterations, residual %.1e of %.1e N\n", tetrahedra, iterations, residual, first);
    // Newton's method ends with steps that make the residual smaller by orders of magnitude.
    if (!(residual <= 1e-11 * first) || iterations > 15 || contraction > 1e-4) return 1;

    // piola's own statics, and the forces of the tetrahedra, which balance the weight where nothing holds it.
    piola::simulation simulation(body, pins, R"({"gravity": [0, 0, -9.81], "newton": {"tolerance": 1e-12}})");
    for (int k = 0; k < 5; k++) simulation.equilibrate();
    const std::vector<double> expected = simulation.read(PIOLA_QUANTITY_POSITIONS);
    double distance = 0.0, sag = 0.0;
    for (std::size_t k = 0; k < x.size(); k++) distance = std::fmax(distance, std::fabs(x[k] - expected[k]));
    for (std::size_t k = 2; k < x.size(); k += 3) sag = std::fmax(sag, mesh.positions[k] - x[k]);
    std::printf("sags by %.4f m; %.1e m from piola's own statics\n", sag, distance);
    const Eigen::VectorXd forces = by_hand(mesh, x, mu, lambda);
    std::vector<double> given(x.size());
    piola::response(body).evaluate(x, given);
    double unbalanced = 0.0, apart = 0.0;
    for (std::size_t k = 0; k < x.size(); k++) {
        const double weight = k % 3 == 2 ? masses[k / 3] * gravity : 0.0;
        if (unknowns[k / 3] != PIOLA_NO_UNKNOWN)
            unbalanced = std::fmax(unbalanced, std::fabs(forces[Eigen::Index(k)] + weight));
        apart = std::fmax(apart, std::fabs(forces[Eigen::Index(k)] - given[k]));
    }
    return distance < 1e-8 && sag > 1e-3 && unbalanced < 1e-9 && apart < 1e-9 ? 0 : 1;
}
