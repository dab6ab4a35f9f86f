/*
 * piola for C++17: the functions of piola.h with handles that free themselves, exceptions, and spans.
 *
 * Every function throws piola::error where that of piola.h returns a code; shapes and units are documented
 * there. What a C++ program hands over is a span: of a std::vector, a std::array, or a pointer with a size.
 */
#ifndef PIOLA_HPP
#define PIOLA_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "piola.h"

namespace piola {

/// What a call that fails throws: its code, and its message as what().
class error : public std::runtime_error {
public:
    error(piola_code code, const char *message) : std::runtime_error(message), code_(code) {}

    piola_code code() const noexcept { return code_; }

private:
    piola_code code_;
};

namespace detail {

inline void check(piola_code code) {
    if (code != PIOLA_CODE_OK) throw error(code, piola_error_message());
}

/// Whether the numbers of a container are in the order that piola has: not those of matrices by columns, which
/// Eigen's are unless told otherwise. A map that transposed them would go unnoticed.
template <class C, class = void>
struct is_in_order : std::true_type {};

template <class C>
struct is_in_order<C, std::void_t<decltype(C::IsRowMajor)>>
    : std::bool_constant<bool(C::IsRowMajor) || bool(C::IsVectorAtCompileTime)> {};

/// What a handle is freed by.
template <auto free>
struct freed_by {
    template <class T>
    void operator()(T *handle) const noexcept {
        free(handle);
    }
};

} // namespace detail

/// Numbers side by side that somebody else owns.
template <class T>
class span {
public:
    constexpr span() noexcept = default;
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}

    template <std::size_t N>
    constexpr span(T (&array)[N]) noexcept : data_(array), size_(N) {}

    /// The numbers of a container; of a matrix of Eigen only where it is by rows.
    template <
        class C, class Plain = std::remove_cv_t<std::remove_reference_t<C>>,
        class Item = std::remove_pointer_t<decltype(std::declval<C &>().data())>,
        class = std::enable_if_t<
            std::is_convertible_v<Item (*)[], T (*)[]> && !std::is_same_v<Plain, span> &&
            (std::is_const_v<T> || std::is_lvalue_reference_v<C>)>>
    constexpr span(C &&container)
        : data_(container.data()), size_(static_cast<std::size_t>(container.size())) {
        static_assert(
            detail::is_in_order<Plain>::value, "a matrix by columns would be taken for its transpose");
    }

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t index) const { return data_[index]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/// Counts of the statuses of many points.
struct survey : piola_survey {
    /// Whether the results of every point mean something.
    bool is_clean() const noexcept { return refused == 0 && nonfinite == 0; }
};

/// An energy of the catalogue, or one that a text declares. Copies share it.
class energy {
public:
    /// An energy of the catalogue, such as "neo_hookean".
    static energy named(const std::string &name) {
        piola_energy *handle = nullptr;
        detail::check(piola_energy_named(name.c_str(), &handle));
        return energy(handle);
    }

    /// An energy in the notation of papers, such as "mu/2*(I1 - 3) - mu*ln(J)".
    static energy formula(const std::string &text) { return declared(text, PIOLA_NOTATION_FORMULA); }

    /// An energy declared in Rust.
    static energy rust(const std::string &text) { return declared(text, PIOLA_NOTATION_RUST); }

    /// What is known of it, as long as it lives.
    const piola_energy_description &describe() const {
        const piola_energy_description *description = nullptr;
        detail::check(piola_energy_describe(get(), &description));
        return *description;
    }

    const piola_energy *get() const noexcept { return handle_.get(); }

private:
    explicit energy(piola_energy *handle) : handle_(handle, piola_energy_free) {}

    static energy declared(const std::string &text, piola_notation notation) {
        piola_energy *handle = nullptr;
        detail::check(piola_energy_declared(text.c_str(), notation, &handle));
        return energy(handle);
    }

    std::shared_ptr<piola_energy> handle_;
};

/// Values of a parameter.
struct parameter {
    std::string name;
    /// One, or several for a list; those of all points one after the other where they vary.
    std::vector<double> values;
    /// Whether each point has values of its own.
    bool varies = false;
};

/// The extension that is best for most: 0.1 where the energy can be continued beyond its domain.
constexpr double automatic = -1.0;

/// An energy with values for its parameters. Copies share it.
class material {
public:
    /// The same for any number of points; for exactly `points` points if that is not 0.
    material(
        const energy &energy, const std::vector<parameter> &parameters, double extension = automatic,
        std::size_t points = 0) {
        std::vector<piola_parameter> given;
        for (const parameter &parameter : parameters) {
            const std::size_t size = parameter.values.size();
            const std::size_t length = parameter.varies && points != 0 ? size / points : size;
            if (parameter.varies && length * points != size) {
                throw error(
                    PIOLA_CODE_LENGTH, ("`" + parameter.name + "` has no values for each point").c_str());
            }
            given.push_back(
                {parameter.name.c_str(), parameter.values.data(), length, parameter.varies ? length : 0});
        }
        piola_material *handle = nullptr;
        detail::check(
            piola_material_new(energy.get(), given.data(), given.size(), extension, points, &handle));
        handle_.reset(handle, piola_material_free);
    }

    /// Moduli at rest, Pa: shear modulus and Lamé's λ.
    std::pair<double, double> moduli() const {
        std::pair<double, double> moduli;
        detail::check(piola_material_moduli(get(), &moduli.first, &moduli.second));
        return moduli;
    }

    const piola_material *get() const noexcept { return handle_.get(); }

private:
    std::shared_ptr<piola_material> handle_;
};

namespace detail {

/// The functions of a precision.
template <class T>
struct functions;

template <>
struct functions<double> {
    static constexpr auto energies = piola_energies;
    static constexpr auto stresses = piola_stresses;
    static constexpr auto tangents = piola_tangents;
    static constexpr auto stresses_in = piola_stresses_in;
    static constexpr auto stiffnesses = piola_stiffnesses;
    static constexpr auto stiffnesses_at = piola_stiffnesses_at;
    static constexpr auto csr_add = piola_csr_add;
};

template <>
struct functions<float> {
    static constexpr auto energies = piola_energies_f32;
    static constexpr auto stresses = piola_stresses_f32;
    static constexpr auto tangents = piola_tangents_f32;
    static constexpr auto stresses_in = piola_stresses_in_f32;
    static constexpr auto stiffnesses = piola_stiffnesses_f32;
    static constexpr auto stiffnesses_at = piola_stiffnesses_at_f32;
    static constexpr auto csr_add = piola_csr_add_f32;
};

} // namespace detail

/// A material with settings to evaluate it at many points at once, in double or in float.
template <class T = double>
class batch {
public:
    explicit batch(material material) : material_(std::move(material)) { options_.size = sizeof options_; }

    batch &filter(piola_filter filter) {
        options_.filter = filter;
        return *this;
    }
    batch &layout(piola_layout layout) {
        options_.layout = layout;
        return *this;
    }
    batch &instructions(piola_instructions instructions) {
        options_.instructions = instructions;
        return *this;
    }
    batch &threads(bool threads) {
        options_.threads = threads;
        return *this;
    }
    /// Room for the status of each point, which must live as long as the batch is called.
    batch &statuses(span<std::uint8_t> statuses) {
        options_.statuses = statuses.data();
        options_.statuses_length = statuses.size();
        return *this;
    }

    survey energies(span<const T> F, span<T> energies) const {
        return call(functions::energies, F, energies);
    }
    survey stresses(span<const T> F, span<T> P) const { return call(functions::stresses, F, P); }
    survey tangents(span<const T> F, span<T> P, span<T> dP_dF) const {
        return call(functions::tangents, F, P, dP_dF);
    }
    survey
    stresses_in(piola_measure measure, span<const T> F, span<T> stresses, span<T> tangents = {}) const {
        return apply(
            [&](auto... arguments) {
                return functions::stresses_in(material_.get(), &options_, measure, arguments...);
            },
            F, stresses, tangents);
    }
    survey stiffnesses(span<const T> F, span<const T> rest, span<T> gradients, span<T> stiffnesses) const {
        return call(functions::stiffnesses, F, rest, gradients, stiffnesses);
    }
    survey stiffnesses_at(
        span<const T> positions, span<const std::size_t> corners, span<const T> rest, span<T> gradients,
        span<T> stiffnesses) const {
        return call(functions::stiffnesses_at, positions, corners, rest, gradients, stiffnesses);
    }

private:
    using functions = detail::functions<T>;

    /// Calls with pointer and size of each span, folded from the last on.
    template <class Function, class... Spans>
    survey call(Function function, Spans... spans) const {
        return apply(
            [&](auto... arguments) { return function(material_.get(), &options_, arguments...); }, spans...);
    }
    template <class Function, class... Spans>
    static survey apply(Function function, Spans... spans) {
        survey survey{};
        const auto arguments = std::tuple_cat(std::make_tuple(spans.data(), spans.size())...);
        detail::check(std::apply(
            [&](auto... arguments) { return function(arguments..., static_cast<piola_survey *>(&survey)); },
            arguments));
        return survey;
    }

    material material_;
    piola_options options_{};
};

/// Shapes of tetrahedra at rest: ten numbers each, for batches.
inline std::vector<double> rest_shapes(span<const double> positions, span<const std::size_t> corners) {
    std::vector<double> rest(corners.size() / 4 * 10);
    detail::check(piola_rest_shapes(
        positions.data(), positions.size(), corners.data(), corners.size(), rest.data(), rest.size()));
    return rest;
}

/// Swaps two nodes of each tetrahedron with a negative volume at rest; returns their number.
inline std::size_t turn_tets(span<const double> positions, span<std::size_t> corners) {
    std::size_t turned = 0;
    detail::check(
        piola_turn_tets(positions.data(), positions.size(), corners.data(), corners.size(), &turned));
    return turned;
}

/// The places of stiffnesses of tetrahedra in a sparse matrix of compressed rows, or columns.
class csr {
public:
    /// Node n has the unknowns 3n, 3n + 1, 3n + 2, or those from `unknowns[n]` on; PIOLA_NO_UNKNOWN for none.
    csr(std::size_t nodes, span<const std::size_t> corners, span<const std::int32_t> row_starts,
        span<const std::int32_t> columns, span<const std::size_t> unknowns = {})
        : csr(piola_csr_new_i32, nodes, corners, row_starts, columns, unknowns) {}

    csr(std::size_t nodes, span<const std::size_t> corners, span<const std::int64_t> row_starts,
        span<const std::int64_t> columns, span<const std::size_t> unknowns = {})
        : csr(piola_csr_new_i64, nodes, corners, row_starts, columns, unknowns) {}

    /// Adds stiffnesses of 144 numbers each to the values of the matrix.
    template <class T>
    void
    add(const std::vector<T> &stiffnesses, span<T> values, piola_layout layout = PIOLA_LAYOUT_POINTS) const {
        detail::check(detail::functions<T>::csr_add(
            handle_.get(), layout, stiffnesses.data(), stiffnesses.size(), values.data(), values.size()));
    }

private:
    template <class New, class I>
    csr(New make, std::size_t nodes, span<const std::size_t> corners, span<const I> row_starts,
        span<const I> columns, span<const std::size_t> unknowns) {
        piola_csr *handle = nullptr;
        detail::check(make(
            nodes, corners.data(), corners.size(), unknowns.data(), unknowns.size(), row_starts.data(),
            row_starts.size(), columns.data(), columns.size(), &handle));
        handle_.reset(handle);
    }

    std::unique_ptr<piola_csr, detail::freed_by<piola_csr_free>> handle_;
};

/// A part of a body.
struct part {
    piola::material material;
    /// kg/m³.
    double density;
};

/// An elastic body at rest. Copies share it.
class body {
public:
    /// A body of one material.
    body(
        span<const double> positions, span<const std::size_t> corners, const material &material,
        double density)
        : body(positions, corners, {}, {part{material, density}}) {}

    /// A body of several parts: `part_of` has that of each tetrahedron.
    body(
        span<const double> positions, span<const std::size_t> corners, span<const std::size_t> part_of,
        const std::vector<part> &parts) {
        std::vector<piola_part> given;
        for (const part &part : parts) given.push_back({part.material.get(), part.density});
        piola_body *handle = nullptr;
        detail::check(piola_body_new(
            positions.data(), positions.size(), corners.data(), corners.size(), part_of.data(),
            part_of.size(), given.data(), given.size(), &handle));
        handle_.reset(handle, piola_body_free);
        nodes_ = positions.size() / 3;
    }

    std::size_t nodes() const noexcept { return nodes_; }

    /// Lumped mass of each node, kg.
    std::vector<double> masses() const {
        std::vector<double> masses(nodes_);
        detail::check(piola_body_masses(get(), masses.data(), masses.size()));
        return masses;
    }

    const piola_body *get() const noexcept { return handle_.get(); }

private:
    std::shared_ptr<piola_body> handle_;
    std::size_t nodes_ = 0;
};

/// Memory to evaluate the energy of a body at any positions.
class response {
public:
    explicit response(const body &body) {
        piola_response *handle = nullptr;
        detail::check(piola_response_new(body.get(), &handle));
        handle_.reset(handle);
    }

    /// Energy, J, and its gradient, N, unless that is empty; the survey goes to where it is wanted.
    double
    evaluate(span<const double> positions, span<double> gradient = {}, survey *survey = nullptr) const {
        double energy = 0.0;
        detail::check(piola_response_evaluate(
            handle_.get(), positions.data(), positions.size(), &energy, gradient.data(), gradient.size(),
            survey));
        return energy;
    }

private:
    std::unique_ptr<piola_response, detail::freed_by<piola_response_free>> handle_;
};

/// Where a term puts its second derivatives.
class blocks {
public:
    explicit blocks(piola_blocks *blocks) : blocks_(blocks) {}

    /// Adds a block of nine numbers by rows, N/m, and its transpose for two different nodes.
    void add(std::size_t row, std::size_t column, const std::array<double, 9> &entries) {
        detail::check(piola_blocks_add(blocks_, row, column, entries.data()));
    }

private:
    piola_blocks *blocks_;
};

/// A potential energy of the positions of all nodes, three numbers each, in addition to that of deformation.
///
/// Its functions are called by one thread at a time, though not that of the caller. What they throw ends the
/// step, which throws it again.
class term {
public:
    virtual ~term() = default;
    /// Energy, J; infinity outside of its domain.
    virtual double energy(span<const double> positions) = 0;
    /// Adds the gradient, N.
    virtual void add_gradient(span<const double> positions, span<double> gradient) = 0;
    /// Adds the second derivatives, N/m, best without negative eigenvalues.
    virtual void add_second_derivatives(span<const double> positions, blocks &blocks) = 0;
    /// The largest share of a displacement with which a line search may begin.
    virtual double longest_step(span<const double> positions, span<const double> displacement) {
        static_cast<void>(positions), static_cast<void>(displacement);
        return 1.0;
    }
};

/// A body with positions and velocities, which steps change.
class simulation {
public:
    /// `settings` are a text in JSON, as of piola_simulation_new.
    explicit simulation(
        const body &body, span<const std::size_t> pins = {}, const std::string &settings = "{}")
        : nodes_(body.nodes()) {
        piola_simulation *handle = nullptr;
        detail::check(piola_simulation_new(body.get(), pins.data(), pins.size(), settings.c_str(), &handle));
        handle_.reset(handle);
    }

    void settings(const std::string &settings) {
        detail::check(piola_simulation_set_settings(handle_.get(), settings.c_str()));
    }

    /// Vectors of all nodes. Reactions have another number: see the other function.
    std::vector<double> read(piola_quantity quantity) const {
        std::vector<double> numbers(3 * nodes_);
        read(quantity, numbers);
        return numbers;
    }
    void read(piola_quantity quantity, span<double> numbers) const {
        detail::check(piola_simulation_read(handle_.get(), quantity, numbers.data(), numbers.size()));
    }
    void write(piola_quantity quantity, span<const double> numbers) {
        detail::check(piola_simulation_write(handle_.get(), quantity, numbers.data(), numbers.size()));
    }

    void pins(span<const std::size_t> nodes) {
        detail::check(piola_simulation_set_pins(handle_.get(), nodes.data(), nodes.size()));
    }
    void prescribe(span<const std::size_t> nodes, span<const double> positions) {
        detail::check(piola_simulation_prescribe(
            handle_.get(), nodes.data(), nodes.size(), positions.data(), positions.size()));
    }
    void springs(span<const piola_spring> springs) {
        detail::check(piola_simulation_set_springs(handle_.get(), springs.data(), springs.size()));
    }
    /// Replaces all terms, which the simulation keeps.
    void terms(const std::vector<std::shared_ptr<term>> &terms) {
        std::vector<std::unique_ptr<called>> kept;
        std::vector<piola_term> given;
        for (const std::shared_ptr<term> &term : terms) {
            kept.push_back(std::make_unique<called>(called{term, nullptr}));
            given.push_back(
                {kept.back().get(), called::energy, called::add_gradient, called::add_second_derivatives,
                 called::longest_step});
        }
        detail::check(piola_simulation_set_terms(handle_.get(), given.data(), given.size()));
        terms_ = std::move(kept);
    }
    /// Compares the derivatives of each term with differences: see piola_simulation_check_terms.
    void check_terms(bool is_filtered = false) {
        advanced(piola_simulation_check_terms(handle_.get(), is_filtered));
    }

    piola_step_report step(double dt) {
        piola_step_report report{};
        advanced(piola_simulation_step(handle_.get(), dt, &report));
        return report;
    }
    piola_step_report equilibrate() {
        piola_step_report report{};
        advanced(piola_simulation_equilibrate(handle_.get(), &report));
        return report;
    }

private:
    /// A term with what one of its functions has thrown, which must not pass through the library.
    struct called {
        std::shared_ptr<term> function;
        std::exception_ptr thrown;

        template <class Body>
        static std::int32_t guarded(void *context, Body body) noexcept {
            called &self = *static_cast<called *>(context);
            try {
                body(*self.function);
                return 0;
            } catch (...) {
                self.thrown = std::current_exception();
                return 1;
            }
        }
        static std::int32_t
        energy(void *context, const double *x, std::size_t nodes, double *energy) noexcept {
            return guarded(context, [&](term &term) { *energy = term.energy({x, 3 * nodes}); });
        }
        static std::int32_t
        add_gradient(void *context, const double *x, std::size_t nodes, double *gradient) noexcept {
            return guarded(context, [&](term &term) {
                term.add_gradient({x, 3 * nodes}, {gradient, 3 * nodes});
            });
        }
        static std::int32_t
        add_second_derivatives(void *context, const double *x, std::size_t nodes, piola_blocks *to) noexcept {
            return guarded(context, [&](term &term) {
                blocks blocks(to);
                term.add_second_derivatives({x, 3 * nodes}, blocks);
            });
        }
        static std::int32_t longest_step(
            void *context, const double *x, const double *d, std::size_t nodes, double *share) noexcept {
            return guarded(context, [&](term &term) {
                *share = term.longest_step({x, 3 * nodes}, {d, 3 * nodes});
            });
        }
    };

    /// Throws what a term has thrown, or else what the library says.
    void advanced(piola_code code) {
        if (code == PIOLA_CODE_CALLBACK) {
            for (const std::unique_ptr<called> &term : terms_) {
                if (term->thrown) std::rethrow_exception(std::exchange(term->thrown, nullptr));
            }
        }
        detail::check(code);
    }

    std::size_t nodes_ = 0;
    std::vector<std::unique_ptr<called>> terms_;
    std::unique_ptr<piola_simulation, detail::freed_by<piola_simulation_free>> handle_;
};

} // namespace piola

#endif
