//! Orders variables by the structure of the model: FORCE (F. Aloul, I. Markov, K. Sakallah, *FORCE: a fast and
//! easy-to-implement variable-ordering heuristic*, GLSVLSI 2003).
//!
//! In: the number of fields, and which of them are related. Out: an order in which related fields are close together.
//! INVARIANT: deterministic.

/// LIMIT: the most rounds.
const ROUNDS: usize = 200;

/// An order of `count` fields; each edge lists related fields.
pub(crate) fn force(count: usize, edges: &[Vec<usize>]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    let mut best = (span(&order, edges), order.clone());
    let mut fruitless = 0;
    for _ in 0..ROUNDS {
        order = round(&order, edges);
        let now = span(&order, edges);
        if now < best.0 {
            best = (now, order.clone());
            fruitless = 0;
        } else {
            fruitless += 1;
            if fruitless == 10 {
                break;
            }
        }
    }
    best.1
}

/// Moves each field to the mean of its edges' centres.
fn round(order: &[usize], edges: &[Vec<usize>]) -> Vec<usize> {
    let place = places(order);
    let mut sums = vec![(0.0, 0.0); order.len()];
    for edge in edges {
        let middle = edge.iter().map(|field| place[*field] as f64).sum::<f64>() / edge.len() as f64;
        for field in edge {
            sums[*field].0 += middle;
            sums[*field].1 += 1.0;
        }
    }
    let mut moved: Vec<(f64, usize)> = order
        .iter()
        .map(|field| match sums[*field] {
            (_, 0.0) => (place[*field] as f64, *field),
            (sum, edges) => (sum / edges, *field),
        })
        .collect();
    moved.sort_by(|a, b| a.0.total_cmp(&b.0).then(place[a.1].cmp(&place[b.1])));
    moved.into_iter().map(|(_, field)| field).collect()
}

/// The sum of the edges' spans.
fn span(order: &[usize], edges: &[Vec<usize>]) -> usize {
    let place = places(order);
    let reach = |edge: &Vec<usize>| {
        let places = edge.iter().map(|field| place[*field]);
        places.clone().max().unwrap_or(0) - places.min().unwrap_or(0)
    };
    edges.iter().map(reach).sum()
}

fn places(order: &[usize]) -> Vec<usize> {
    let mut places = vec![0; order.len()];
    for (place, field) in order.iter().enumerate() {
        places[*field] = place;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_matters_to_each_other_comes_together() {
        // Fields i and i + 8 are related, like the two functions of each of eight philosophers.
        let edges: Vec<Vec<usize>> = (0..8).map(|i| vec![i, i + 8]).collect();
        let order = force(16, &edges);
        assert_eq!(span(&order, &edges), 8, "{order:?}");
        let mut sorted = order;
        sorted.sort_unstable();
        assert_eq!(sorted, (0..16).collect::<Vec<_>>());
    }

    #[test]
    fn a_chain_keeps_its_order() {
        let edges: Vec<Vec<usize>> = (0..9).map(|i| vec![i, i + 1]).collect();
        assert_eq!(force(10, &edges), (0..10).collect::<Vec<_>>());
    }
}
