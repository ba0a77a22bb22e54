//! The moment that is looked at: it follows the computation until somebody takes it, stands still until it is played,
//! and stops at the end.

/// Seconds in which the whole duration is played.
const WHOLE_S: f64 = 10.0;

/// The moment that is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Player {
    /// T.
    time: f64,
    /// The last T there is.
    end: f64,
    playing: bool,
    taken: bool,
}

impl Player {
    /// T, as far as the computation has come.
    pub fn time(&self) -> f64 {
        self.time.min(self.end)
    }

    /// The last T there is.
    pub fn end(&self) -> f64 {
        self.end
    }

    pub fn playing(&self) -> bool {
        self.playing
    }

    /// Says how far the computation has come.
    pub fn reached(&mut self, time: f64) {
        self.end = time;
        if !self.taken {
            self.time = time;
        }
    }

    /// Goes to a moment and stays there.
    pub fn go_to(&mut self, time: f64) {
        (self.taken, self.playing) = (true, false);
        self.time = time.clamp(0.0, self.end);
    }

    /// Plays from here, from the beginning where it stands at the end, or pauses.
    pub fn toggle(&mut self) {
        self.taken = true;
        self.playing = !self.playing;
        if self.playing && self.time >= self.end {
            self.time = 0.0;
        }
    }

    /// Goes on by what has passed on the clock, of a whole of `duration`.
    pub fn advance(&mut self, seconds: f64, duration: f64) {
        if self.playing {
            self.time = (self.time + seconds * duration / WHOLE_S).min(self.end);
            self.playing = self.time < self.end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_follows_until_it_is_taken_and_plays_to_the_end() {
        let mut player = Player::default();
        player.reached(3.0);
        assert_eq!(player.time(), 3.0);
        player.go_to(7.0);
        player.reached(4.0);
        assert_eq!((player.time(), player.end()), (3.0, 4.0));
        player.advance(1.0, 8.0);
        assert_eq!(player.time(), 3.0, "nothing moves unasked");
        player.reached(1.0);
        assert_eq!(player.time(), 1.0, "a new run has come no farther");
        player.reached(4.0);
        assert_eq!(player.time(), 3.0, "and goes where somebody wanted to look");
        player.toggle();
        player.advance(1.0, 8.0);
        assert!((player.time() - 3.8).abs() < 1e-12 && player.playing());
        player.advance(1.0, 8.0);
        assert_eq!((player.time(), player.playing()), (4.0, false));
        player.toggle();
        assert_eq!((player.time(), player.playing()), (0.0, true));
    }
}
