% nlvib.m - one response curve by NLvib, in Octave; called by versus_peer.py, which writes the problem and reads the curve.
% usage: octave-cli nlvib.m FOLDER PROBLEM CURVE      (FOLDER: NLvib's SRC is in it)
%   PROBLEM   lines of a word and numbers: n, M, D, K (by rows), force (of cos(omega t)), H, N, sweep FROM TO, step, scale, omega_scale, tolerance;
%             jenkins KT LIMIT DIRECTION..., spring KN CLEARANCE DIRECTION...
%   CURVE     a line for each point: omega, |residual|/|force|, the coefficients as NLvib has them: 0, cos 1, sin 1, ..., n of each
% Printed last, in seconds of processor time: solve_and_continue, first solution included; the residuals and writing; evaluations.
1;
function x = numbers(parts)
  x = cellfun(@str2double, parts);
end
given = argv();
addpath(fullfile(given{1}, 'SRC'), fullfile(given{1}, 'SRC', 'MechanicalSystems'));
elements = {};
p = struct();
for text = strsplit(strtrim(fileread(given{2})), "\n")
  parts = strsplit(strtrim(text{1}), ' ');
  x = numbers(parts(2:end));
  switch parts{1}
    case {'M', 'D', 'K'}
      p.(parts{1}) = reshape(x, p.n, p.n)';
    case 'jenkins'
      elements{end + 1} = struct('type', 'elasticDryFriction', 'stiffness', x(1), 'friction_limit_force', x(2), ...
                                 'ishysteretic', true, 'force_direction', x(3:end)');
    case 'spring'
      elements{end + 1} = struct('type', 'unilateralSpring', 'stiffness', x(1), 'gap', x(2), 'force_direction', x(3:end)');
    otherwise
      p.(parts{1}) = x;
  end
end
system_of = MechanicalSystem(p.M, p.D, p.K, elements, p.force');
stuck = p.K; % the guess: linear, sliders stuck
for e = elements
  if strcmp(e{1}.type, 'elasticDryFriction')
    stuck += e{1}.stiffness * e{1}.force_direction * e{1}.force_direction';
  end
end
from = p.sweep(1);
q = (-from^2 * p.M + 1i * from * p.D + stuck) \ p.force';
x0 = zeros((2 * p.H + 1) * p.n, 1);
x0(p.n + (1:2 * p.n)) = [real(q); -imag(q)];
options = struct('Dscale', [p.scale * ones(size(x0)); p.omega_scale], 'stepmax', 20000, ...
                 'parametrization', 'orthogonal', 'dsmin', p.step / 500);
fsolve_options = optimset('Display', 'off', 'Jacobian', 'on', 'MaxIter', 50, 'TolX', p.tolerance, 'TolFun', p.tolerance); % NLvib's own, and the tolerance
began = cputime();
[X, information] = solve_and_continue(x0, @(y) HB_residual(y, system_of, p.H, p.N, 'frf'), from, p.sweep(2), p.step, options, {}, fsolve_options);
seconds = cputime() - began;
checking = cputime();
residual = cellfun(@(x) norm(HB_residual(x, system_of, p.H, p.N, 'frf')), num2cell(X, 1)) / norm(p.force);
file = fopen(given{3}, 'w');
fprintf(file, [repmat('%.17g ', 1, rows(X)), '%.17g\n'], [X(end, :); residual; X(1:end - 1, :)]);
fclose(file);
printf('%.6f %.6f %d\n', seconds, cputime() - checking, information.FCtotal);
