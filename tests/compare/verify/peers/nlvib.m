% nlvib.m - response curves by NLvib for ../../../../cases/verify/: frequency response of an oscillator on a
% unilateral spring, by harmonic balance with sampled forces (AFT) and arc-length continuation.
%
%   octave -q --no-gui nlvib.m NLVIB COMMIT TARGET
%     NLVIB   a checkout of https://github.com/maltekrack/NLvib
%     COMMIT  what it is a checkout of, for the files' remarks
%     TARGET  the folder to write into
%
% NLvib's unilateral spring: f = k max(q - gap, 0). Case 2 of the paper never slips, so it is one, of
% kt cos^2 + kn sin^2 from x = -gap/sin(angle) on. Under a preload, gap g > 0, our force is k max(q + g, 0) - k g = k q + k max(-q - g, 0);
% with -q for q that is a spring k beside K and a unilateral spring of -k: NLvib needs no static force then.
%
% The columns are NLvib's own quantities, as its examples 02 and 07 plot them: the root of the sum of squares of all
% coefficients, that of harmonic 0 too, divided by the root of 2; and the modulus of harmonic 1.
arguments = argv();
[nlvib, commit, target] = arguments{:};
addpath(fullfile(nlvib, 'SRC'), fullfile(nlvib, 'SRC', 'MechanicalSystems'));

function write_curve(path, remarks, oscillator, omega_from, omega_to, step, most_steps, H, N)
  X1 = oscillator.Fex1/(oscillator.K - omega_from^2*oscillator.M + 1i*omega_from*oscillator.D);
  start = zeros(2*H + 1, 1);
  start(2:3) = [real(X1); -imag(X1)];
  continuation = struct('Dscale', [ones(size(start)); omega_from], 'dynamicDscale', 1, 'stepmax', most_steps);
  newton = optimset('Display', 'off', 'Jacobian', 'on', 'MaxIter', 50, 'TolFun', 1e-10, 'TolX', 1e-10);
  residual = @(X) HB_residual(X, oscillator, H, N, 'frf');
  X = solve_and_continue(start, residual, omega_from, omega_to, step, continuation, {}, newton);
  file = fopen(path, 'w');
  fprintf(file, '%s', remarks);
  fprintf(file, '# H = %d, N = %d, step %g from omega %g to %g, at most %d steps.\n', H, N, step, omega_from, ...
          omega_to, most_steps);
  fprintf(file, 'omega,norm_over_root_2,harmonic_1\n');
  fprintf(file, '%.10g,%.10g,%.10g\n', [X(end,:); sqrt(sum(X(1:end-1,:).^2, 1))/sqrt(2); hypot(X(2,:), X(3,:))]);
  fclose(file);
end

function o = oscillator(mass, damping, stiffness, force, spring, gap)
  contact = struct('type', 'unilateralSpring', 'stiffness', spring, 'gap', gap, 'ishysteretic', 0, 'islocal', 1);
  o = SingleMassOscillator(mass, damping, stiffness, {contact}, force);
end

function remarks = remarks_of(commit, what)
  remarks = sprintf('# %s, by NLvib (commit %s) in GNU Octave %s, %s.\n', what, commit, version(), date());
  remarks = [remarks, sprintf('# Made by tests/compare/verify/peers/nlvib.m; nothing was left out.\n')];
end

case2 = oscillator(1, 0.4, 40, 100, 100*cosd(45)^2 + 1000*sind(45)^2, 5/sind(45));
clearance = oscillator(1, 0.06, 1, 0.2, 2, 1);
preloaded = oscillator(1, 0.06, 1 + 2, -0.2, -2, 0.5);
function write_one(target, commit, name, what, varargin)
  write_curve(fullfile(target, name), remarks_of(commit, what), varargin{:});
end

%         the file, what it is                                          oscillator, sweep, step, most steps, H, N
write_one(target, commit, 'nlvib_case2.csv', 'Case 2',                    case2, 3, 20, 0.2, 200, 10, 1024);
write_one(target, commit, 'nlvib_case2_n32.csv', 'Case 2',                case2, 3, 20, 0.1, 200, 10, 32);
write_one(target, commit, 'nlvib_clearance.csv', 'The unilateral spring, gap -1', ...
          clearance, 0.4, 2.5, 0.01, 200, 7, 1024);
write_one(target, commit, 'nlvib_wandered.csv', 'The unilateral spring, gap -1, wandering', ...
          clearance, 0.4, 2.5, 0.02, 200, 7, 4096);
write_one(target, commit, 'nlvib_preloaded.csv', 'The unilateral spring, gap 0.5', ...
          preloaded, 0.4, 2.5, 0.02, 200, 10, 4096);
