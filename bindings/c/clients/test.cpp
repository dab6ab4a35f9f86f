// The classes of piola.hpp and the matrices of piola_eigen.hpp. Prints what fails, and returns 1 then.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <Eigen/LU>

#include "piola_eigen.hpp"

namespace {

int failures = 0;

#define CHECK(holds)                                                                                         \
    do {                                                                                                     \
        if (!(holds)) {                                                                                      \
            std::printf("%s:%d: %s\n", __FILE__, __LINE__, #holds);                                          \
            failures++;                                                                                      \
        }                                                                                                    \
    } while (false)

/// Checks that a call throws an error of this code, with this text in its message.
template <class Call>
void fails(Call call, piola_code code, const std::string &text) {
    try {
        call();
        std::printf("no error about `%s`\n", text.c_str());
        failures++;
    } catch (const piola::error &error) {
        CHECK(error.code() == code);
        if (std::string(error.what()).find(text) == std::string::npos) {
            std::printf("`%s` is not in: %s\n", text.c_str(), error.what());
            failures++;
        }
    }
}

const std::vector<piola::parameter> parameters = {{"mu", {1e6}}, {"lambda", {4e6}}};

piola::material rubber() {
    return piola::material(piola::energy::named("neo_hookean"), parameters, 0.0);
}

void energies() {
    const piola::energy energy =
        piola::energy::formula("mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2 where J > 0");
    const piola_energy_description &description = energy.describe();
    CHECK(description.parameter_count == 2 && std::string(description.parameters[1].name) == "lambda");
    const auto [mu, lambda] = piola::material(energy, parameters).moduli();
    CHECK(std::fabs(mu - 1e6) < 1e-6 && std::fabs(lambda - 4e6) < 1e-6);
    fails([] { piola::energy::named("jelly"); }, PIOLA_CODE_MATERIAL, "there is no material `jelly`");
    fails([] { piola::energy::formula("mu*("); }, PIOLA_CODE_ENERGY, "mu*(");
    fails([] { piola::energy::rust("fn"); }, PIOLA_CODE_ENERGY, "");
    fails(
        [&] {
            piola::material(energy, {{"mu", {1.0}}});
        },
        PIOLA_CODE_MATERIAL, "needs a value for `lambda`");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    fails([&] { piola::material(energy, {{"mu", {nan}}, {"lambda", {1.0}}}); }, PIOLA_CODE_MATERIAL, "`mu`");
}

/// In double and in float: P = mu F + (lambda ln J - mu) F^-T.
template <class T>
void batches(T tolerance) {
    using matrix = piola::matrix3<T>;
    const std::size_t points = 40;
    std::vector<matrix> F(points);
    for (std::size_t p = 0; p < points; p++) {
        F[p] << T(1.1), T(0.2), 0, T(-0.1), T(0.9), T(0.05), 0, T(0.3), T(1.0) + T(0.01) * T(p);
    }
    std::vector<T> energies(points), P(9 * points), full(81 * points);
    std::vector<std::uint8_t> statuses(points, 255);
    piola::batch<T> batch(rubber());
    batch.filter(PIOLA_FILTER_NONE).threads(true).statuses(statuses);
    CHECK(batch.energies(piola::numbers(F), energies).is_clean());
    CHECK(batch.tangents(piola::numbers(F), P, full).is_clean());
    CHECK(statuses == std::vector<std::uint8_t>(points, 0));
    for (std::size_t p = 0; p < points; p++) {
        const T J = F[p].determinant();
        const matrix inverse = F[p].inverse().transpose();
        const matrix expected = T(1e6) * F[p] + (T(4e6) * std::log(J) - T(1e6)) * inverse;
        CHECK((piola::matrix(P, p) - expected).norm() < tolerance * T(1e6));
        CHECK((piola::tangent(full, p) - piola::tangent(full, p).transpose()).norm() == 0);
    }
    std::vector<T> alone(9 * points);
    CHECK(batch.stresses(piola::numbers(F), alone).is_clean());
    std::vector<T> sigma(6 * points), rate(36 * points);
    CHECK(batch.stresses_in(PIOLA_MEASURE_CAUCHY, piola::numbers(F), sigma, rate).is_clean());
    CHECK(batch.stresses_in(PIOLA_MEASURE_KIRCHHOFF, piola::numbers(F), sigma).is_clean());
    fails([&] { batch.stresses(piola::numbers(F), sigma); }, PIOLA_CODE_LENGTH, "`P` has 240 entries");
    fails([&] { batch.stresses({nullptr, 9}, P); }, PIOLA_CODE_POINTER, "`F` is null");
    // What is outside the domain is counted, and thrown for nowhere.
    F[3].row(0) *= T(-1);
    F[7](0, 0) = std::numeric_limits<T>::infinity();
    const piola::survey survey = batch.stresses(piola::numbers(F), P);
    CHECK(survey.refused >= 1 && survey.nonfinite >= 1 && survey.first == 3 && !survey.is_clean());
    CHECK((statuses[3] & PIOLA_STATUS_REFUSED) && (statuses[7] & PIOLA_STATUS_NONFINITE) && statuses[8] == 0);
}

void parameters_vary() {
    const piola::energy energy = piola::energy::named("neo_hookean");
    const piola::material graded(energy, {{"mu", {1e6, 2e6}, true}, {"lambda", {4e6}}}, 0.0, 2);
    const piola::matrix3<double> shear = (piola::matrix3<double>() << 1, 0.2, 0, 0, 1, 0, 0, 0, 1).finished();
    const std::vector<piola::matrix3<double>> F = {shear, shear};
    std::vector<double> P(18);
    piola::batch<>(graded).stresses(piola::numbers(F), P);
    CHECK(std::fabs(P[1] - 0.2e6) < 1e-6 && std::fabs(P[10] - 0.4e6) < 1e-6);
    fails(
        [&] {
            piola::material(energy, {{"mu", {1, 2, 3}, true}, {"lambda", {1}}}, 0.0, 2);
        },
        PIOLA_CODE_LENGTH, "`mu`");
}

// Matrices by columns are not spans: `piola::span<const double>(Eigen::Matrix3d())` does not compile. Vectors and
// matrices by rows are.
static_assert(!piola::detail::is_in_order<Eigen::Matrix3d>::value);
static_assert(piola::detail::is_in_order<Eigen::VectorXd>::value);
static_assert(piola::detail::is_in_order<piola::matrix3<double>>::value);
static_assert(!std::is_convertible_v<const std::vector<double> &, piola::span<double>>);
static_assert(!std::is_convertible_v<std::vector<float> &, piola::span<double>>);

void matrices_are_not_transposed() {
    const Eigen::Matrix3d by_columns = (Eigen::Matrix3d() << 1, 0.2, 0, 0, 1, 0, 0, 0, 1).finished();
    std::vector<double> F(9), P(9);
    piola::matrix(F, 0) = by_columns;
    CHECK(F[1] == 0.2 && F[3] == 0.0);
    piola::batch<>(rubber()).stresses(F, P);
    const Eigen::Matrix3d stress = piola::matrix(P, 0);
    CHECK(std::fabs(stress(0, 1) - 0.2e6) < 1e-6);
    const Eigen::VectorXd flat = Eigen::Map<Eigen::VectorXd>(F.data(), 9);
    piola::batch<>(rubber()).stresses(flat, P);
    CHECK(P[1] == stress(0, 1));
}

const std::vector<double> corners_at = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::size_t> corners = {0, 1, 2, 3};

/// Throws something of its own where it is told to.
class weight : public piola::term {
public:
    struct broken {
        int function;
    };

    int fails_in = 0;

    double energy(piola::span<const double> x) override {
        fail(1);
        double energy = 0.0;
        for (std::size_t n = 0; n < x.size() / 3; n++) energy += 5.0 * x[3 * n] * x[3 * n];
        return energy;
    }
    void add_gradient(piola::span<const double> x, piola::span<double> gradient) override {
        fail(2);
        for (std::size_t n = 0; n < x.size() / 3; n++) gradient[3 * n] += 10.0 * x[3 * n];
    }
    void add_second_derivatives(piola::span<const double> x, piola::blocks &blocks) override {
        fail(3);
        for (std::size_t n = 0; n < x.size() / 3; n++) blocks.add(n, n, {10, 0, 0, 0, 0, 0, 0, 0, 0});
    }

private:
    void fail(int function) const {
        if (function == fails_in) throw broken{function};
    }
};

void simulations() {
    const piola::body body(corners_at, corners, rubber(), 1000.0);
    piola::simulation simulation(body, {}, R"({"gravity": [0, 0, -10]})");
    const auto term = std::make_shared<weight>();
    simulation.terms({term});
    CHECK(simulation.step(0.01).terms > 0.0);
    for (int function : {1, 2, 3}) {
        const std::vector<double> before = simulation.read(PIOLA_QUANTITY_POSITIONS);
        term->fails_in = function;
        bool has_thrown = false;
        try {
            simulation.step(0.01);
        } catch (const weight::broken &broken) {
            has_thrown = broken.function == function;
        }
        CHECK(has_thrown && simulation.read(PIOLA_QUANTITY_POSITIONS) == before);
    }
    term->fails_in = 0;
    simulation.step(0.01);
    // Moved, it goes on with the functions of its terms.
    piola::simulation moved = std::move(simulation);
    CHECK(moved.step(0.01).terms > 0.0);
    moved.terms({});
    CHECK(moved.step(0.01).terms == 0.0);
    const std::vector<std::size_t> pins = {0, 1, 2};
    moved.pins(pins);
    std::vector<double> reactions(9);
    moved.equilibrate();
    moved.read(PIOLA_QUANTITY_REACTIONS, reactions);
    CHECK(std::fabs(reactions[2] + reactions[5] + reactions[8] - 10.0 * 1000.0 / 6.0) < 0.1);
    moved.prescribe(std::vector<std::size_t>{0}, std::array<double, 3>{0.0, 0.0, -0.01});
    moved.springs(std::vector<piola_spring>{{{3, 3, 3, 3}, {1, 0, 0, 0}, {0, 0, 2}, 100.0}});
    CHECK(moved.step(0.01).springs > 0.0);
    moved.write(PIOLA_QUANTITY_VELOCITIES, std::vector<double>(12, 0.0));
    moved.settings(R"({"integrator": "sdirk3"})");
    CHECK(moved.step(0.001).convergence != PIOLA_CONVERGENCE_LIMIT);
    fails([&] { moved.settings("{\"gravitas\": 1}"); }, PIOLA_CODE_VALUE, "unknown field `gravitas`");
    fails([&] { moved.step(-1.0); }, PIOLA_CODE_STEP, "the time step is -1 s");
    fails(
        [&] { moved.write(PIOLA_QUANTITY_POSITIONS, reactions); }, PIOLA_CODE_VALUE,
        "expected one entry for each of 4 nodes");
    fails([&] { piola::body(corners_at, corners, rubber(), -1.0); }, PIOLA_CODE_BODY, "the density is -1");
}

void bodies() {
    const std::vector<double> x = {0, 0, 0, 1.2, 0.1, 0, 0, 0.9, 0.2, 0.1, 0, 1.1};
    const piola::body body(corners_at, corners, {}, {piola::part{rubber(), 1000.0}});
    std::vector<std::size_t> reversed = {0, 2, 1, 3};
    CHECK(piola::turn_tets(corners_at, reversed) == 1 && reversed == corners);
    const std::vector<double> rest = piola::rest_shapes(corners_at, corners);
    std::vector<double> gradients(12), stiffnesses(144), from_body(12);
    const piola::batch<> batch(rubber());
    CHECK(batch.stiffnesses_at(x, corners, rest, gradients, stiffnesses).is_clean());
    std::vector<double> F(9);
    piola::matrix(F, 0) << 1.2, 0, 0.1, 0.1, 0.9, 0, 0, 0.2, 1.1;
    std::vector<double> again(12);
    CHECK(batch.stiffnesses(F, rest, again, stiffnesses).is_clean());
    piola::survey survey{};
    CHECK(piola::response(body).evaluate(x, from_body, &survey) > 0.0 && survey.is_clean());
    for (std::size_t r = 0; r < 12; r++) {
        CHECK(std::fabs(gradients[r] - from_body[r]) < 1e-6);
        CHECK(std::fabs(gradients[r] - again[r]) < 1e-6);
    }
    // A matrix with indices of 64 bits.
    std::vector<std::int64_t> starts, columns;
    for (int r = 0; r <= 12; r++) starts.push_back(12 * r);
    for (int k = 0; k < 144; k++) columns.push_back(k % 12);
    std::vector<double> values(144, 1.0);
    piola::csr(4, corners, starts, columns).add(stiffnesses, piola::span<double>(values));
    for (std::size_t k = 0; k < 144; k++) CHECK(values[k] == 1.0 + stiffnesses[k]);
    // In single precision: a hundred roundings of moduli of 4e6.
    const std::vector<float> x_32(x.begin(), x.end()), rest_32(rest.begin(), rest.end()),
        F_32(F.begin(), F.end());
    std::vector<float> gradients_32(12), again_32(12), stiffnesses_32(144), values_32(144, 0.0f);
    const piola::batch<float> single(rubber());
    CHECK(single.stiffnesses(F_32, rest_32, again_32, stiffnesses_32).is_clean());
    CHECK(single.stiffnesses_at(x_32, corners, rest_32, gradients_32, stiffnesses_32).is_clean());
    piola::csr(4, corners, starts, columns).add(stiffnesses_32, piola::span<float>(values_32));
    for (std::size_t k = 0; k < 144; k++) CHECK(std::fabs(values_32[k] - stiffnesses[k]) < 40.0);
    for (std::size_t k = 0; k < 12; k++) {
        CHECK(
            std::fabs(gradients_32[k] - gradients[k]) < 40.0 && std::fabs(again_32[k] - gradients[k]) < 40.0);
    }
    fails([&] { piola::csr(3, corners, starts, columns); }, PIOLA_CODE_VALUE, "names node 3");
}

void threads() {
    const piola::material shared = rubber();
    std::vector<std::thread> threads;
    std::array<bool, 4> agree{};
    for (bool &agrees : agree) {
        threads.emplace_back([&agrees, shared] {
            const std::vector<double> F = {1, 0.2, 0, 0, 1, 0, 0, 0, 1};
            std::vector<double> P(9);
            agrees = true;
            for (int k = 0; k < 1000; k++) {
                piola::batch<>(shared).stresses(F, P);
                agrees = agrees && std::fabs(P[1] - 0.2e6) < 1e-6;
            }
        });
    }
    for (std::thread &thread : threads) thread.join();
    for (const bool agrees : agree) CHECK(agrees);
}

} // namespace

int main() {
    energies();
    batches<double>(1e-13);
    batches<float>(1e-5f);
    parameters_vary();
    matrices_are_not_transposed();
    simulations();
    bodies();
    threads();
    return failures != 0;
}
