% nlvib.m - runs NLvib (M. Krack and J. Gross, GPL) on the suite, by its public functions; nothing of it is stored here.
%     octave-cli nlvib.m NLVIB_FOLDER SUITE_FOLDER OUT.json [--refined H N] [H N [NAME...]]      7 and 1024, as in its example 07
% A case that its functions cannot say has no results: a static load or one of a higher harmonic (HB_residual has Fex1
% alone), a preloaded stop, friction under a normal load that varies.
% Solutions: solve_and_continue over the case's frequencies, then fsolve on HB_residual at each that the curve passes;
% --refined H N: from there fsolve with the harmonics that the case asks, at most H, and N samples.

function element = element_of(c, n)
  has = @(key) isfield(c, key);
  element = [];
  if has('law') && strcmp(c.law, 'polynomial')
    powers = fieldnames(c.coefficients);
    if n == 1 % its polynomial stiffness acts on coordinates
      element = struct('type', 'polynomialStiffness', 'islocal', 0, 'exponents', cellfun(@(p) str2double(p(2:end)), powers), ...
                       'coefficients', cellfun(@(p) c.coefficients.(p), powers));
    elseif numel(powers) == 1 && strcmp(powers{1}, 'x3')
      element = struct('type', 'cubicSpring', 'stiffness', c.coefficients.x3, 'force_direction', c.direction(:));
    end
  elseif has('law') && strcmp(c.law, 'tanh')
    element = struct('type', 'tanhDryFriction', 'friction_limit_force', c.friction * c.preload, 'eps', c.epsilon, ...
                     'force_direction', c.tangent(:));
  elseif has('tangent') && ~has('normal')
    element = struct('type', 'elasticDryFriction', 'stiffness', c.tangential_stiffness, 'friction_limit_force', ...
                     c.friction * c.preload, 'ishysteretic', true, 'force_direction', c.tangent(:));
  elseif ~has('tangent') && c.gap <= 0
    element = struct('type', 'unilateralSpring', 'stiffness', c.normal_stiffness, 'gap', -c.gap, 'force_direction', c.normal(:));
  end
  if ~isempty(element) && n == 1 && isfield(element, 'force_direction') && element.force_direction ~= 1
    element = []; % with one coordinate the direction is left out
  end
end

function rows = solve_case(k, H, N, fine)
  rows = {};
  M = k.model.mass; D = k.model.damping; K = k.model.stiffness; n = size(M, 1); elements = {}; Fex1 = zeros(n, 1); stuck = zeros(n);
  for j = 1:numel(k.model.loads)
    if k.model.loads(j).harmonic ~= 1, return; end
    Fex1 = Fex1 + k.model.loads(j).cos(:) - 1i * k.model.loads(j).sin(:);
  end
  contacts = k.model.contacts;
  if ~iscell(contacts), contacts = num2cell(contacts); end
  for j = 1:numel(contacts)
    elements{j} = element_of(contacts{j}, n);
    if isempty(elements{j}), return; end
    if strcmp(elements{j}.type, 'elasticDryFriction')
      stuck = stuck + elements{j}.stiffness * elements{j}.force_direction * elements{j}.force_direction';
    end
  end
  system = MechanicalSystem(M, D, K, elements, Fex1);
  omega = k.omega(:)'; from = 0.8 * min(omega); to = 1.25 * max(omega);
  x0 = zeros((2 * H + 1) * n, 1);
  q = (-from^2 * M + 1i * from * D + K + stuck) \ Fex1;
  x0(n + (1:2 * n)) = [real(q); -imag(q)];
  X = solve_and_continue(x0, @(Y) HB_residual(Y, system, H, N, 'FRF'), from, to, 0.02 * from, struct('stepmax', 2000), ...
                         {}, optimset('Display', 'off', 'Jacobian', 'on', 'MaxIter', 50)); % its own, in Octave's words
  options = optimset('Jacobian', 'on', 'TolFun', 1e-12, 'TolX', 1e-12, 'Display', 'off');
  Hs = H; Ns = N;
  if numel(fine), Hs(2) = max(H, min(fine(1), k.harmonics)); Ns(2) = fine(2); end
  for w = omega
    for j = find((X(end, 1:end-1) - w) .* (X(end, 2:end) - w) <= 0)
      s = (w - X(end, j)) / (X(end, j + 1) - X(end, j));
      x = X(1:end-1, j) + s * (X(1:end-1, j + 1) - X(1:end-1, j));
      for i = 1:numel(Hs)
        x(end+1:(2 * Hs(i) + 1) * n, 1) = 0;
        [x, ~, flag] = fsolve(@(x) at(x, w, system, Hs(i), Ns(i)), x, options);
        if flag <= 0, break; end
      end
      if flag <= 0, continue; end
      y = k.response(:)' * reshape(x, n, []); % mean, cosine and sine of each harmonic
      spectrum = zeros(65536, 1);
      spectrum(2:Hs(end) + 1) = y(2:2:end) - 1i * y(3:2:end);
      motion = 65536 * real(ifft(spectrum));
      rows{end + 1} = struct('omega', w, 'amplitude', (top(motion) + top(-motion)) / 2, 'mean', y(1), 'a1', y(2), 'b1', y(3)); %#ok<AGROW>
    end
  end
end

function m = top(y) % of the parabola through the largest sample and its neighbours
  [m, i] = max(y);
  a = y(mod(i - 2, numel(y)) + 1); c = y(mod(i, numel(y)) + 1);
  m = m + (c - a)^2 / (8 * (2 * m - a - c));
end

function [R, J] = at(x, w, system, H, N)
  [R, J] = HB_residual([x; w], system, H, N, 'FRF');
  J = J(:, 1:end-1);
end

arguments = argv(); fine = [];
at_refined = find(strcmp(arguments, '--refined'));
if at_refined, fine = str2double(arguments(at_refined + (1:2))); arguments(at_refined + (0:2)) = []; end
addpath(fullfile(arguments{1}, 'SRC'), fullfile(arguments{1}, 'SRC', 'MechanicalSystems'));
suite = arguments{2}; H = 7; N = 1024;
if numel(arguments) > 4, H = str2double(arguments{4}); N = str2double(arguments{5}); end
names = jsondecode(fileread(fullfile(suite, 'suite.json'))).cases;
if numel(arguments) > 5, names = arguments(6:end); end
results = struct();
for j = 1:numel(names)
  name = names{j};
  try
    k = jsondecode(fileread(fullfile(suite, 'cases', [name, '.json'])));
    evalc('rows = solve_case(k, H, N, fine);'); % it prints every step
    if ~isempty(rows), results.(name) = rows; end
    printf('%s %d\n', name, numel(rows));
  catch problem
    printf('%s: %s\n', name, problem.message);
  end
end
to = fopen(arguments{3}, 'w');
fputs(to, jsonencode(struct('program', [sprintf('NLvib, H = %d, N = %d', H, N), sprintf(', refined %d %d', fine)], 'cases', results)));
fclose(to);
