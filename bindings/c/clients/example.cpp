#include <iostream>

#include "piola_eigen.hpp"

int main() try {
    const piola::energy energy = piola::energy::formula("mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2");
    const piola::material rubber(energy, {{"mu", {1e6}}, {"lambda", {4e6}}});
    // A thousand points, their matrices by rows.
    std::vector<piola::matrix3<double>> F(1000, piola::matrix3<double>::Identity());
    std::vector<double> P(9 * F.size()), dP_dF(81 * F.size());
    F[7](0, 1) = 0.2;
    const piola::survey survey =
        piola::batch<>(rubber).filter(PIOLA_FILTER_CLAMP).tangents(piola::numbers(F), P, dP_dF);
    std::cout << survey.is_clean() << ", P of point 7 in Pa:\n" << piola::matrix(P, 7) << "\n";
} catch (const piola::error &error) {
    std::cerr << error.what() << "\n";
    return 1;
}
