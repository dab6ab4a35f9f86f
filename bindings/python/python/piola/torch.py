"""Energies for torch: functions that `backward` and `torch.autograd.grad` differentiate.

What is computed runs on the processor; tensors elsewhere are copied there and back.
"""

import numpy as np
import torch


def energy(material, F):
    """ψ, Pa, of shape (...), of F of shape (..., 3, 3): twice differentiable."""
    return _Energy.apply(F, material)


def stress(material, F, **parameters):
    """P, Pa, of F, of shapes (..., 3, 3): differentiable in F and in the parameters, tensors by their names.

    Parameters that are not given keep the values of the material. Those that are given are numbers: of lists,
    all entries in a row. Curves have no derivatives here: `Material.stress_by_parameters` has those by ordinates.
    """
    known = material.parameters
    spellings = ((name, f"{name}_", name.removesuffix("_")) for name in parameters)
    names = tuple(next((name for name in names if name in known), names[0]) for names in spellings)
    return _Stress.apply(F, material, names, *parameters.values())


class _Energy(torch.autograd.Function):
    @staticmethod
    def forward(ctx, F, material):
        ctx.material = material
        ctx.save_for_backward(F)
        return _tensor(material.energy(_array(F), trailing=False), F)

    @staticmethod
    def backward(ctx, by_energy):
        (F,) = ctx.saved_tensors
        return (by_energy[..., None, None] * _Stress.apply(F, ctx.material, ())).sum_to_size(F.shape), None


class _Stress(torch.autograd.Function):
    @staticmethod
    def forward(ctx, F, material, names, *values):
        ctx.names = names
        ctx.material = material
        if names:
            changed = {name: value.detach().cpu().numpy() for name, value in zip(names, values)}
            ctx.material = material.changed(**{name: value.tolist() for name, value in changed.items()})
        ctx.save_for_backward(F)
        return _tensor(ctx.material.stress(_array(F), trailing=False), F)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx, by_stress):
        (F,) = ctx.saved_tensors
        by_F, by_values = None, [None] * len(ctx.names)
        if ctx.needs_input_grad[0]:
            A = _tensor(ctx.material.tangent(_array(F), trailing=False)[1], F)
            by_F = torch.einsum("...ij,...ijkl->...kl", by_stress, A).sum_to_size(F.shape)
        if any(ctx.needs_input_grad[3:]):
            derivatives = ctx.material.stress_by_parameters(_array(F))
            by_values = [_sum(_tensor(derivatives[name], F) * by_stress, F.dim()) for name in ctx.names]
        return (by_F, None, None, *by_values)


def _sum(product, dimensions):
    """The sum over the points and entries of stress: a number, or one for each entry of a list."""
    return product.sum(dim=tuple(range(-dimensions, 0)))


def _array(tensor):
    return tensor.detach().cpu().contiguous().numpy()


def _tensor(array, like):
    return torch.from_numpy(np.asarray(array)).to(like.device)
