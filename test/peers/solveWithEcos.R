# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
# Solves minimise q'x subject to A x = b, G x + s = h, s in rays and second-order cones, with ECOS.
#
#     Rscript solveWithEcos.R PROBLEM SOLUTION TOLERANCE
#
# PROBLEM, of test/peers/Ecos.cpp, is a sequence of numbers: unknowns, equations, rays, cones of 2 or 3, their
# size; q; b; h; entries of A, then row, column (from 1) and value of each; likewise G. SOLUTION gets CPU seconds,
# iterations, x and the multipliers of the equations, one after the other.
library(ECOSolveR)
library(Matrix)
arguments <- commandArgs(trailingOnly = TRUE)
numbers <- scan(arguments[1], quiet = TRUE)
place <- 0
take <- function(count) {
  part <- if (count > 0) numbers[place + seq_len(count)] else numeric(0)
  place <<- place + count
  part
}
sizes <- as.integer(take(5))
q <- take(sizes[1])
b <- take(sizes[2])
h <- take(sizes[3] + sizes[4] * sizes[5])
takeMatrix <- function(rows) {
  count <- take(1)
  entries <- matrix(take(3 * count), nrow = 3)
  sparseMatrix(i = entries[1, ], j = entries[2, ], x = entries[3, ], dims = c(rows, sizes[1]))
}
A <- takeMatrix(sizes[2])
G <- takeMatrix(length(h))
tolerance <- as.numeric(arguments[3])
start <- proc.time()[["user.self"]]
answer <- ECOS_csolve(c = q, G = G, h = h, dims = list(l = sizes[3], q = rep(sizes[5], sizes[4]), e = 0L), A = A, b = b,
                      control = ecos.control(maxit = 200L, feastol = tolerance, reltol = tolerance, abstol = tolerance))
seconds <- proc.time()[["user.self"]] - start
writeLines(format(c(seconds, answer$retcodes[["iter"]], answer$x, answer$y), digits = 17), arguments[2])
