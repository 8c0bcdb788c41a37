m = 1; c = 0.4; k = 40; F0 = 100; kt = 100; kn = 1000; mu = 0.3; gap = -5; a = sqrt(0.5);
H = 10; samples = 1024; th = 2 * pi * (0:samples - 1)' / samples; h = 1:H; cosine = 1 + h; sine = 1 + H + h;
E = [ones(samples, 1), cos(th * h), sin(th * h)];           % x = E X

omega = (4:0.25:8)'; amplitude = zeros(size(omega)); X = zeros(2 * H + 1, 1);
for j = 1:numel(omega)
  S = k - m * (h' * omega(j)).^2; D = c * h' * omega(j);
  for newton = 1:10                                         % from the solution before
    P = [X, X * ones(1, 2 * H + 1) + 1e-7 * eye(2 * H + 1)]; % X, and X with one coefficient changed
    u = a * E * P; N = max(kn * (u + gap), 0); T = zeros(size(u)); w = zeros(1, 2 * H + 2);
    for i = [1:samples, 1:samples]                          % the second period is the steady one
      w = min(max(w, u(i, :) - mu * N(i, :) / kt), u(i, :) + mu * N(i, :) / kt);
      T(i, :) = kt * (u(i, :) - w);
    end
    F = 2 / samples * E' * (a * (T + N)); F(2, :) = F(2, :) - F0;
    R = [P(1, :)
         S .* P(cosine, :) + D .* P(sine, :) + F(cosine, :)
         S .* P(sine, :) - D .* P(cosine, :) + F(sine, :)];
    X = X - (R(:, 2:end) - R(:, 1)) / 1e-7 \ R(:, 1);
  end
  amplitude(j) = (max(E * X) - min(E * X)) / 2;
end

dlmwrite('own_aft.csv', [omega, amplitude], 'precision', 16);
[status, csv] = system(['hbmcheck verify cases/verify/case2.yaml --against own_aft.csv ' ...
                        '--columns omega=1,amplitude=2 --format csv --quiet']);
cause = regexp(csv, '# cause: (\S+)', 'tokens', 'once');
points = textscan(regexprep(csv, '^[#o][^\n]*\n', '', 'lineanchors'), '%f %f %f %f %s %f %s %f', 'Delimiter', ',');
fprintf('%d of %d points differ, by %.0f %% at most: %s\n', sum(strcmp(points{7}, 'differs')), ...
        numel(omega), 100 * max(points{6}), cause{1});
