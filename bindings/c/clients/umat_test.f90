! The UMAT against formulas and central differences, called as Abaqus calls it.
module checks
    implicit none
    integer :: failures = 0, exits = 0
contains
    subroutine check(holds, what)
        logical, intent(in) :: holds
        character(*), intent(in) :: what
        if (.not. holds) then
            print '(2a)', 'umat: ', what
            failures = failures + 1
        end if
    end subroutine

    real(8) function determinant(F)
        real(8), intent(in) :: F(3, 3)
        determinant = F(1, 1)*(F(2, 2)*F(3, 3) - F(2, 3)*F(3, 2)) - F(1, 2)*(F(2, 1)*F(3, 3) - F(2, 3)*F(3, 1)) &
            + F(1, 3)*(F(2, 1)*F(3, 2) - F(2, 2)*F(3, 1))
    end function

    subroutine call_umat(name, props, ntens, F, stress, ddsdde, sse, pnewdt)
        character(*), intent(in) :: name
        integer, intent(in) :: ntens
        real(8), intent(in) :: props(:), F(3, 3)
        real(8), intent(out) :: stress(ntens), ddsdde(ntens, ntens), sse, pnewdt
        character(80) :: cmname
        real(8) :: statev(1), spd, scd, rpl, ddsddt(6), drplde(6), drpldt, stran(6), dstran(6), time(2), dtime, temp
        real(8) :: dtemp, predef(1), dpred(1), coords(3), drot(3, 3), celent, rest(3, 3)
        integer :: jstep(4)
        external :: umat
        cmname = name
        statev = 0; spd = 0; scd = 0; rpl = 0; ddsddt = 0; drplde = 0; drpldt = 0; stran = 0; dstran = 0; time = 0
        dtime = 1; temp = 0; dtemp = 0; predef = 0; dpred = 0; coords = 0; drot = 0; celent = 1; rest = 0; jstep = 1
        stress = 0; ddsdde = 0; sse = 0; pnewdt = 1
        call umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, &
            temp, dtemp, predef, dpred, cmname, 3, ntens - 3, ntens, 1, props, size(props), coords, drot, pnewdt, &
            celent, rest, F, 1, 1, 1, 1, jstep, 1)
    end subroutine

    ! Column K of the tangent: F is followed by a stretch I + h E, E symmetric with engineering shears, which does
    ! not turn, so that the rate of Jaumann is that of J sigma.
    subroutine check_tangent(name, props, F)
        character(*), intent(in) :: name
        real(8), intent(in) :: props(:), F(3, 3)
        integer, parameter :: first(6) = [1, 2, 3, 1, 1, 2], second(6) = [1, 2, 3, 2, 3, 3]
        real(8), parameter :: h = 1d-5
        real(8) :: stress(6), ddsdde(6, 6), sse, pnewdt, moved(3, 3), ahead(6), behind(6), ignored(6, 6), column(6)
        integer :: k
        call call_umat(name, props, 6, F, stress, ddsdde, sse, pnewdt)
        call check(pnewdt == 1 .and. maxval(abs(stress)) > 0, name//': no stress')
        do k = 1, 6
            call stretch(F, k, h, moved)
            call call_umat(name, props, 6, moved, ahead, ignored, sse, pnewdt)
            ahead = ahead*determinant(moved)
            call stretch(F, k, -h, moved)
            call call_umat(name, props, 6, moved, behind, ignored, sse, pnewdt)
            behind = behind*determinant(moved)
            column = (ahead - behind)/(2*h*determinant(F))
            ! Errors of h**2 times third derivatives, and of roundings over h.
            call check(maxval(abs(column - ddsdde(:, k))) < 1d-8*maxval(abs(ddsdde)), name//': not the tangent')
        end do
        call check(maxval(abs(ddsdde - transpose(ddsdde))) == 0, name//': not symmetric')
    contains
        subroutine stretch(F, k, h, moved)
            real(8), intent(in) :: F(3, 3), h
            integer, intent(in) :: k
            real(8), intent(out) :: moved(3, 3)
            real(8) :: by(3, 3)
            by = 0
            by(1, 1) = 1; by(2, 2) = 1; by(3, 3) = 1
            by(first(k), second(k)) = by(first(k), second(k)) + h/2
            by(second(k), first(k)) = by(second(k), first(k)) + h/2
            moved = matmul(by, F)
        end subroutine
    end subroutine
end module

! Abaqus' own ends the analysis; this one counts.
subroutine xit()
    use checks
    exits = exits + 1
end subroutine

program umat_test
    use checks
    implicit none
    real(8), parameter :: mu = 1d6, lambda = 4d6
    real(8) :: F(3, 3), mirrored(3, 3), b(3, 3), J, stress(6), ddsdde(6, 6), sse, pnewdt, expected(6), energy
    real(8) :: plane(3, 3), plane_stress(4), plane_ddsdde(4, 4)
    F = reshape([1.2d0, 0.1d0, -0.05d0, 0.3d0, 0.9d0, 0.2d0, 0.0d0, -0.1d0, 1.1d0], [3, 3])
    J = determinant(F)
    b = matmul(F, transpose(F))
    call call_umat('NEO_HOOKEAN', [mu, lambda], 6, F, stress, ddsdde, sse, pnewdt)
    expected = mu/J*[b(1, 1) - 1, b(2, 2) - 1, b(3, 3) - 1, b(1, 2), b(1, 3), b(2, 3)]
    expected(1:3) = expected(1:3) + lambda*log(J)/J
    call check(maxval(abs(stress - expected)) < 1d-12*lambda, 'not the Cauchy stress')
    energy = mu/2*(b(1, 1) + b(2, 2) + b(3, 3) - 3) - mu*log(J) + lambda/2*log(J)**2
    call check(abs(sse - energy/J) < 1d-12*lambda, 'not the energy')

    call check_tangent('NEO_HOOKEAN', [mu, lambda], F)
    call check_tangent('Hencky', [mu, lambda], F)
    call check_tangent('ST_VENANT_KIRCHHOFF', [mu, lambda], F)
    ! Three terms: mu(3), alpha(3), kappa.
    call check_tangent('OGDEN', [6.3d5, 1.2d3, -1d4, 1.3d0, 5d0, -2d0, 1d6], F)

    ! Plane strain has the part of a solid.
    plane = F
    plane(3, 1:2) = 0; plane(1:2, 3) = 0
    call call_umat('NEO_HOOKEAN', [mu, lambda], 6, plane, stress, ddsdde, sse, pnewdt)
    call call_umat('NEO_HOOKEAN', [mu, lambda], 4, plane, plane_stress, plane_ddsdde, sse, pnewdt)
    call check(all(plane_stress == stress(1:4)) .and. all(plane_ddsdde == ddsdde(1:4, 1:4)), 'not plane strain')

    mirrored = F
    mirrored(:, 1) = -F(:, 1)
    call call_umat('NEO_HOOKEAN', [mu, lambda], 6, mirrored, stress, ddsdde, sse, pnewdt)
    call check(pnewdt < 1 .and. exits == 0, 'an inverted point asks for no shorter increment')
    call call_umat('JELLY', [mu, lambda], 6, F, stress, ddsdde, sse, pnewdt)
    call check(exits == 1, 'an unknown name goes on')
    call call_umat('NEO_HOOKEAN', [mu], 6, F, stress, ddsdde, sse, pnewdt)
    call check(exits == 2, 'a missing parameter goes on')
    call call_umat('NEO_HOOKEAN', [mu, lambda, mu], 6, F, stress, ddsdde, sse, pnewdt)
    call check(exits == 3, 'a parameter too many goes on')
    call call_umat('NEO_HOOKEAN', [-mu, lambda], 6, F, stress, ddsdde, sse, pnewdt)
    call check(exits == 4, 'a negative modulus goes on')
    if (failures > 0) stop 1
end program
