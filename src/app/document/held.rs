//! Held quantities: a typed quantity keeps its value, and others change instead when M or L changes.

use super::experiment::Document;
use crate::app::refusal::Refusal;
use crate::scene::{LoadFollower, LubricantFollower};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::Moes;

/// Quantities that follow M and L.
pub type Followers = (LoadFollower, LubricantFollower);

/// Returns the quantities that change with M and with L.
fn movers((load, lubricant): Followers) -> (&'static [Quantity], &'static [Quantity]) {
    use LubricantFollower::{Alpha, Radius, Realisation, Speed};
    use Quantity as Q;
    match (load, lubricant) {
        (LoadFollower::Load, Realisation) => (&[Q::Load], &[Q::Alpha, Q::Speed, Q::Load]),
        (LoadFollower::Load, Speed) => (&[Q::Load], &[Q::Speed, Q::Load]),
        (LoadFollower::Load, Alpha) => (&[Q::Load], &[Q::Alpha]),
        (LoadFollower::Load, Radius) => (&[Q::Load], &[Q::Radius, Q::Load]),
        (LoadFollower::Radius, Realisation) => (&[Q::Radius, Q::Speed, Q::Alpha], &[Q::Radius, Q::Speed, Q::Alpha]),
        (LoadFollower::Radius, Speed | Radius) => (&[Q::Radius, Q::Speed], &[Q::Radius, Q::Speed]),
        (LoadFollower::Radius, Alpha) => (&[Q::Radius, Q::Alpha], &[Q::Alpha]),
        (LoadFollower::Speed, _) => (&[Q::Speed, Q::Alpha], &[Q::Alpha]),
    }
}

impl Document {
    /// Returns true if a quantity was typed and keeps its value.
    pub fn holds(&self, quantity: Quantity) -> bool {
        self.view.held.contains(quantity)
    }

    /// Sets a typed quantity and holds it.
    ///
    /// # Errors
    /// A sentence if the value is refused. The document is then unchanged.
    pub fn type_quantity(&mut self, quantity: Quantity, value: f64) -> Result<(), Refusal> {
        self.set_quantity(quantity, value)?;
        self.view.held.set(quantity, true);
        Ok(())
    }

    /// Returns the quantities that follow when M, L or both change. These are the chosen ones if they change no
    /// held quantity, otherwise the first pair that does not.
    ///
    /// # Errors
    /// A sentence that names the held quantities, if no quantity is left to follow.
    pub fn followers_for(&self, m_moves: bool, l_moves: bool) -> Result<Followers, Refusal> {
        let chosen = self.followers();
        let free = |pair: &Followers| {
            let (with_m, with_l) = movers(*pair);
            let with_m = with_m.iter().filter(|_| m_moves);
            let mut moving = with_m.chain(with_l.iter().filter(|_| l_moves));
            moving.all(|quantity| !self.holds(*quantity))
        };
        let alpha_is_free = self.lubricant.own_coefficient().is_none();
        let others = LoadFollower::ALL.into_iter().flat_map(|load| load.partners().iter().map(move |l| (load, *l)));
        // If the lubricant determines α, neither α nor a combination with α may follow.
        let possible = others.filter(|(load, lubricant)| {
            let moves_alpha = matches!(lubricant, LubricantFollower::Alpha | LubricantFollower::Realisation);
            alpha_is_free || !moves_alpha && *load != LoadFollower::Speed
        });
        std::iter::once(chosen).chain(possible).find(free).ok_or_else(|| {
            let held: Vec<&str> = Quantity::SI.into_iter().filter(|q| self.holds(*q)).map(Quantity::name).collect();
            let moving = if m_moves { "M" } else { "L" };
            let held = held.join(", ");
            Refusal::new(format!("{moving} cannot change: {held} are held; release one of them with its lock"))
        })
    }

    /// Returns the quantities that follow in a change to M and L.
    pub(super) fn followers_to(&self, wanted: Moes) -> Result<Followers, Refusal> {
        let here = self.point.moes();
        let moved = |from: f64, to: f64| (to / from - 1.0).abs() > 1e-12;
        self.followers_for(moved(here.m, wanted.m), moved(here.l, wanted.l))
    }

    /// Returns “follows M”, “follows L” or both for a quantity that is not held.
    pub fn follows(&self, quantity: Quantity) -> &'static str {
        let with_m = self.followers_for(true, false).is_ok_and(|pair| movers(pair).0.contains(&quantity));
        let with_l = self.followers_for(false, true).is_ok_and(|pair| movers(pair).1.contains(&quantity));
        match (with_m, with_l) {
            (true, true) => "follows M, L",
            (true, false) => "follows M",
            (false, true) => "follows L",
            (false, false) => "",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Shape;

    #[test]
    fn nothing_held_ever_moves_whatever_is_dragged() {
        let mut random = fastrand::Rng::with_seed(3);
        let mut refused = 0;
        for shape in Shape::ALL {
            let mut document = Document::default();
            document.set_shape(shape).unwrap();
            for _ in 0..2000 {
                let held: Vec<(Quantity, f64)> = Quantity::SI
                    .into_iter()
                    .filter(|q| document.holds(*q))
                    .map(|q| (q, q.of(&document.point).unwrap()))
                    .collect();
                let quantity = Quantity::SI[random.usize(..6)];
                let moes = document.point.moes();
                let factor = 0.8 + 0.45 * random.f64();
                let typed = match random.usize(..5) {
                    0 => {
                        let value = quantity.of(&document.point).unwrap() * factor;
                        document.type_quantity(quantity, value).ok().map(|()| quantity)
                    }
                    1 => {
                        document.view.held.set(quantity, false);
                        Some(quantity)
                    }
                    2 => {
                        refused += usize::from(document.set_moes(Moes { l: moes.l * factor, ..moes }).is_err());
                        None
                    }
                    _ => {
                        refused += usize::from(document.set_moes(Moes { m: moes.m * factor, ..moes }).is_err());
                        None
                    }
                };
                for (quantity, value) in held {
                    let now = quantity.of(&document.point).unwrap();
                    assert!(typed == Some(quantity) || now == value, "{} was {value} and is {now}", quantity.name());
                }
            }
        }
        assert!(refused > 0, "the walk never came to where nothing is left to move");
    }

    #[test]
    fn another_quantity_gives_way_for_one_that_is_held_and_is_named() {
        let mut document = Document::default();
        assert_eq!(document.follows(Quantity::Load), "follows M, L");
        let load = document.point.load;
        document.type_quantity(Quantity::Load, 1.1 * load).unwrap();
        assert_eq!((document.follows(Quantity::Load), document.follows(Quantity::Radius)), ("", "follows M"));
        for quantity in [Quantity::Radius, Quantity::Speed, Quantity::Alpha] {
            document.view.held.set(quantity, true);
        }
        let said = document.set_moes(Moes { m: 50.0, ..document.point.moes() }).unwrap_err();
        assert!(said.contains("radius, speed, load, alpha are held"), "{said}");
    }
}
